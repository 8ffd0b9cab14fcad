# Every target of ours links overt_warnings; third-party headers are SYSTEM and stay silent.
add_library(overt_warnings INTERFACE)
target_compile_options(overt_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual)
