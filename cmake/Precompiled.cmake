# The headers that nearly every file includes are compiled once (precompiled.h) and shared by all targets, for all are
# compiled with the same flags. Each file still names what it uses: cmake -DOVERT_PRECOMPILED=OFF builds without.
option(OVERT_PRECOMPILED "Compile common headers once" ON)

add_library(overt_precompiled STATIC ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
target_link_libraries(overt_precompiled PRIVATE glm::glm fmt::fmt overt_warnings)
if(OVERT_PRECOMPILED)
    target_precompile_headers(overt_precompiled PRIVATE ${CMAKE_SOURCE_DIR}/cmake/precompiled.h)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # With this a compiler cache can tell what the precompiled header stands for.
        target_compile_options(overt_precompiled PUBLIC -fpch-preprocess)
    endif()
endif()

function(overt_precompile target)
    if(OVERT_PRECOMPILED)
        target_precompile_headers(${target} REUSE_FROM overt_precompiled)
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            target_compile_options(${target} PRIVATE -fpch-preprocess)
        endif()
    endif()
endfunction()
