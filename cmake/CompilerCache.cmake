# ccache is used where it is installed; cmake -DOVERT_CCACHE=OFF builds without.
option(OVERT_CCACHE "Use ccache where it is installed" ON)
find_program(OVERT_CCACHE_PROGRAM ccache)
if(OVERT_CCACHE AND OVERT_CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # What a precompiled header defines and when it was made does not change what is compiled with it.
    set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
                                    ${OVERT_CCACHE_PROGRAM})
endif()
