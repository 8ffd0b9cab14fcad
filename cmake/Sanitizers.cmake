# -DOVERT_SANITIZE=address,undefined or =thread instruments everything we build.
set(OVERT_SANITIZE "" CACHE STRING "Sanitizers to build with, as for -fsanitize=; empty for none")
if(OVERT_SANITIZE)
    add_compile_options(-fsanitize=${OVERT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${OVERT_SANITIZE})
endif()

# -DOVERT_FUZZ=ON, with clang: everything is instrumented for the fuzzers in tests/fuzz.
if(OVERT_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer
                        -fno-sanitize-recover=all)
    add_link_options(-fsanitize=address,undefined)
endif()
