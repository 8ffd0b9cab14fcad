// Owns the precompiled header; see Precompiled.cmake.
