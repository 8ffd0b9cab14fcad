// Owns the precompiled header; see Effort.cmake.
