# Run at each build: writes OUTPUT with what was built, from which commit; touches it only when that changed.
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
if(commit AND changes)
    set(commit "${commit}, with changes")
endif()
set(text "#pragma once
namespace overt::build {
inline constexpr const char* version = \"${VERSION}\";
inline constexpr const char* compiler = \"${COMPILER}\";
inline constexpr const char* flags = \"${FLAGS}\";
inline constexpr const char* type = \"${TYPE}\";
inline constexpr const char* libraries = \"${LIBRARIES}\";
inline constexpr const char* commit = \"${commit}\";
} // namespace overt::build
")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} before)
endif()
if(NOT "${before}" STREQUAL "${text}")
    file(WRITE ${OUTPUT} "${text}")
endif()
