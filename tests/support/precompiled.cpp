// Owns the precompiled header of the tests; catch_main.cpp has to see Catch2 in another way.
