# overt_room(USES rooms… [LINKS libraries…] [EMBEDS header texts…]): a folder of the program is a room, and a room is a
# library of the .cpp files that lie in it, not of those in folders below it. USES names the rooms whose headers it may
# include; what those use, it may include too. A room can only use what was declared before it, so arrows cannot run in a
# circle. LINKS are libraries that only its own .cpp files see. EMBEDS puts text files into a header made at build time.
#
# A room's target is its folder with underscores: experiment/record/asc is overt_experiment_record_asc.
function(overt_room_target room result)
    string(REPLACE "/" "_" name ${room})
    set(${result} overt_${name} PARENT_SCOPE)
endfunction()

function(overt_room room)
    cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "USES;LINKS;EMBEDS")
    if(ROOM_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "${room}: not understood: ${ROOM_UNPARSED_ARGUMENTS}")
    endif()
    overt_room_target(${room} target)
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${room}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/app/main\\.cpp$")
    add_library(${target} STATIC ${sources})
    target_include_directories(${target} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(${target} PUBLIC glm::glm fmt::fmt PRIVATE overt_warnings ${ROOM_LINKS})
    foreach(used IN LISTS ROOM_USES)
        overt_room_target(${used} used_target)
        if(NOT TARGET ${used_target})
            message(FATAL_ERROR "${room} uses ${used}, which is no room or is declared after it")
        endif()
        target_link_libraries(${target} PUBLIC ${used_target})
    endforeach()
    if(ROOM_EMBEDS)
        overt_embed_text(${target} ${ROOM_EMBEDS})
    endif()
    overt_precompile(${target})
    # What the architecture test holds the includes against.
    set_property(GLOBAL APPEND_STRING PROPERTY OVERT_ROOMS "${room}: ${ROOM_USES}\n")
endfunction()

# Writes the rooms and what they use, a line each, to `file`.
function(overt_write_rooms file)
    get_property(rooms GLOBAL PROPERTY OVERT_ROOMS)
    string(REPLACE ";" " " rooms "${rooms}")
    file(CONFIGURE OUTPUT ${file} CONTENT "${rooms}" @ONLY)
endfunction()
