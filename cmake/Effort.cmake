# How hard the compiler works on a file, and what it reads only once for all of them.
#
# overt_effort(NAME HEADER [options…]) declares a kind of effort: options of a Release build, and a precompiled header that all
# targets of this effort share, for a header serves only what is compiled with the options that it was made with.
# overt_compile_with(target NAME) compiles a target so. Each file still names what it uses: cmake -DOVERT_PRECOMPILED=OFF
# builds without precompiled headers.
option(OVERT_PRECOMPILED "Compile common headers once" ON)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # It looks for memory to use again when it has taken this much, in kB, and not at each few MB: a tenth of its time.
    add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:--param ggc-min-heapsize=500000 --param ggc-min-expand=100>")
endif()

function(overt_effort name header)
    set(target overt_effort_${name})
    add_library(${target} STATIC ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
    target_link_libraries(${target} PRIVATE glm::glm fmt::fmt overt_warnings)
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR})
    target_compile_options(${target} PRIVATE "$<$<CONFIG:Release>:${ARGN}>")
    set_target_properties(${target} PROPERTIES OVERT_EFFORT "${ARGN}")
    if(OVERT_PRECOMPILED)
        target_precompile_headers(${target} PRIVATE ${CMAKE_SOURCE_DIR}/${header})
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            # With this a compiler cache can tell what the precompiled header stands for.
            target_compile_options(${target} PRIVATE -fpch-preprocess)
        endif()
    endif()
endfunction()

function(overt_compile_with target name)
    get_target_property(options overt_effort_${name} OVERT_EFFORT)
    target_compile_options(${target} PRIVATE "$<$<CONFIG:Release>:${options}>")
    if(OVERT_PRECOMPILED)
        target_precompile_headers(${target} REUSE_FROM overt_effort_${name})
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            target_compile_options(${target} PRIVATE -fpch-preprocess)
        endif()
    endif()
endfunction()

# What someone waits for: loops over meshes, maps, light, samples. All optimisation.
overt_effort(hot cmake/precompiled.h)
# The rest: commands, keys, checks, tables, talk with devices. Little more than half of the compiler's time.
overt_effort(plain cmake/precompiled.h -Og)
