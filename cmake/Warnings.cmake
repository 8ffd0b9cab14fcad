# Every target of ours links overt_warnings; third-party headers are SYSTEM and stay silent.
add_library(overt_warnings INTERFACE)
target_compile_options(overt_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # g++ 12 warns of every "literal" + std::string (GCC bug 105651).
    target_compile_options(overt_warnings INTERFACE -Wno-restrict)
endif()
