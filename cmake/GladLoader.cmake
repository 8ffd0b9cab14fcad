# OpenGL 3.3 core function tables, one per context (--mx), generated at build time: glad is the loader that also works
# with OSMesa. Nothing of it is in this tree.
find_program(GLAD_GENERATOR glad REQUIRED DOC "glad 2 generator (Debian: python3-glad)")
set(glad_dir ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
    OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h
    COMMAND ${GLAD_GENERATOR} --quiet --reproducible --api gl:core=3.3
            --extensions GL_KHR_debug,GL_ARB_timer_query,GL_ARB_buffer_storage,GL_ARB_texture_storage
            --out-path ${glad_dir} c --mx
    COMMENT "Generating the OpenGL loader"
    VERBATIM)
add_library(overt_glad STATIC ${glad_dir}/src/gl.c)
target_include_directories(overt_glad SYSTEM PUBLIC ${glad_dir}/include)
