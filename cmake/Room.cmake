# overt_room(USES rooms… [LINKS libraries…] [EMBEDS header texts…] [APART patterns…] [HOT]): a folder of the program is
# a room, and a room is a library of the .cpp files that lie in it, not of those in folders below it. USES names the rooms
# whose headers it may include; what those use, it may include too. A room can only use what was declared before it, so
# arrows cannot run in a circle. LINKS are libraries that only its own .cpp files see. EMBEDS puts text files into a header
# made at build time.
#
# The files of a room are compiled OVERT_UNITY at a time, since most of a compiler's time goes to headers that they share:
# 24 at a time take two thirds of the processor time of 8 at a time, which suit whoever changes one file after another.
# Any two of them can meet, in which case the words of their unnamed namespaces are common: what two files need is written
# once, in a header. APART names files that are alike on purpose, a kind of thing each, and files with types that the linker
# must not see; they are compiled alone.
# HOT rooms are those whose loops someone waits for (meshes, maps, light, statistics, reading and writing records): compiled
# with all optimisation (Effort.cmake).
#
# A room's target is its folder with underscores: experiment/record/asc is overt_experiment_record_asc.
set(OVERT_UNITY 24 CACHE STRING "How many files of a room are compiled together; 0: each alone")

function(overt_room_target room result)
    string(REPLACE "/" "_" name ${room})
    set(${result} overt_${name} PARENT_SCOPE)
endfunction()

function(overt_compile_together target)
    if(OVERT_UNITY)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${OVERT_UNITY})
    endif()
endfunction()

function(overt_room room)
    cmake_parse_arguments(PARSE_ARGV 1 ROOM "HOT" "" "USES;LINKS;EMBEDS;APART")
    if(ROOM_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "${room}: not understood: ${ROOM_UNPARSED_ARGUMENTS}")
    endif()
    overt_room_target(${room} target)
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${room}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
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
    if(ROOM_HOT)
        overt_compile_with(${target} hot)
    else()
        overt_compile_with(${target} plain)
    endif()
    overt_compile_together(${target})
    foreach(pattern IN LISTS ROOM_APART)
        file(GLOB apart CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${room}/${pattern})
        set_source_files_properties(${apart} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endforeach()
    # What the architecture test holds the includes against.
    set_property(GLOBAL APPEND_STRING PROPERTY OVERT_ROOMS "${room}: ${ROOM_USES}\n")
endfunction()

# The rooms in `folder` that were declared so far.
function(overt_rooms_in folder result)
    get_property(rooms GLOBAL PROPERTY OVERT_ROOMS)
    string(REGEX MATCHALL "${folder}/[a-z_/]+:" found "${rooms}")
    list(TRANSFORM found REPLACE ":" "")
    set(${result} ${found} PARENT_SCOPE)
endfunction()

# Writes the rooms and what they use, a line each, to `file`.
function(overt_write_rooms file)
    get_property(rooms GLOBAL PROPERTY OVERT_ROOMS)
    string(REPLACE ";" " " rooms "${rooms}")
    file(CONFIGURE OUTPUT ${file} CONTENT "${rooms}" @ONLY)
endfunction()

# overt_module(ROOM NAME name USES rooms… LINKS libraries…): a room whose libraries take long to load is a module of its own,
# which the program loads when it needs it: lib/overt/NAME.so. It sees the headers of the rooms it uses, not their code.
function(overt_module room)
    cmake_parse_arguments(PARSE_ARGV 1 MODULE "" "NAME" "USES;LINKS")
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${room}/*.cpp)
    add_library(${MODULE_NAME} MODULE ${sources})
    target_include_directories(${MODULE_NAME} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${MODULE_NAME} PRIVATE glm::glm overt_warnings ${MODULE_LINKS})
    set_target_properties(${MODULE_NAME} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
                          LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/overt)
    # What is linked with the room that loads it has it built, too.
    foreach(used IN LISTS MODULE_USES)
        overt_room_target(${used} used_target)
        add_dependencies(${used_target} ${MODULE_NAME})
    endforeach()
    set_property(GLOBAL APPEND_STRING PROPERTY OVERT_ROOMS "${room}: ${MODULE_USES}\n")
endfunction()
