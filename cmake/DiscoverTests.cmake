# Run after a test program is linked: writes the CTest script FILE with its tests, labelled with their one tag out of unit,
# gl, session and bench. A test case of a session or a benchmark is a test of its own. The cases of a file that are tagged
# unit or gl are one test, named after program and file: hundreds of programs that each load some 280 libraries for a case of
# milliseconds take longer than the cases. A test case without such a tag stops the build, for it would never be run; one
# that is tagged [.long] is run by hand (tests/README.md). A test that is also tagged [waits], or a file with such a case,
# spends most of its time waiting for a screen, a device or an observer in real time: it takes one place and any other test
# four, so that ./test runs three of them beside the others. CTest goes through the tests from the highest
# cost down and starts those for which there are places: tests of app/, whole sessions among them, come first, since they
# take longest, and tests that wait come last, so that they take only the places that others leave.
cmake_policy(VERSION 3.25)

function(list_of_program result pattern)
    execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE lines ERROR_VARIABLE lines RESULT_VARIABLE count)
    # The program ends with a number, whatever it lists; one that cannot be run answers with words.
    if(NOT count MATCHES "^[0-9]+$")
        message(FATAL_ERROR "${PROGRAM}: its tests cannot be listed: ${count}")
    endif()
    # A name may have a semicolon, which would part it in a list.
    string(REPLACE ";" "<semicolon>" lines "${lines}")
    string(REGEX REPLACE "\n+" ";" lines "${lines}")
    list(FILTER lines INCLUDE REGEX "${pattern}")
    set(${result} "${lines}" PARENT_SCOPE)
endfunction()

list_of_program(unlabelled "." "~[unit]~[gl]~[session]~[bench]~[.long]" --list-test-names-only)
if(unlabelled)
    message(FATAL_ERROR "Test cases without a tag [unit], [gl], [session] or [bench]: ${unlabelled}")
endif()

get_filename_component(program "${PROGRAM}" NAME)
set(waits PROCESSORS 1 COST 1)
set(computes PROCESSORS 4 COST 2)
if(program STREQUAL "app_tests")
    set(computes PROCESSORS 4 COST 3)
endif()
set(script "")
function(add_program_test name label specification)
    list(JOIN ARGN " " share)
    string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[${specification}]==] \"-#\")\n"
        "set_tests_properties([==[${name}]==] PROPERTIES LABELS ${label} TIMEOUT ${TIMEOUT} ${share} "
        "SKIP_RETURN_CODE ${SKIPPED} "
        "WORKING_DIRECTORY [==[${FOLDER}]==] ENVIRONMENT [==[${ENVIRONMENT}]==])\n")
    set(script "${script}" PARENT_SCOPE)
endfunction()

foreach(label unit gl)
    # Catch2's option -# gives each case the name of its file as a tag.
    list_of_program(files "\\[#" "[${label}]" -\# --list-tags)
    list_of_program(waiting "\\[#" "[${label}][waits]" -\# --list-tags)
    foreach(list files waiting)
        list(TRANSFORM ${list} REPLACE ".*\\[#(.*)\\].*" "\\1")
    endforeach()
    foreach(file IN LISTS files)
        set(name "${program} ${file}")
        if(NOT label STREQUAL "unit")
            string(APPEND name " (${label})")
        endif()
        set(share ${computes})
        if(file IN_LIST waiting)
            set(share ${waits})
        endif()
        add_program_test("${name}" ${label} "[#${file}][${label}]" ${share})
    endforeach()
endforeach()
foreach(label session bench)
    list_of_program(tests "." "[${label}]" --list-test-names-only)
    list_of_program(waiting "." "[${label}][waits]" --list-test-names-only)
    foreach(test IN LISTS tests)
        set(share ${computes})
        if(test IN_LIST waiting)
            set(share ${waits})
        endif()
        string(REPLACE "<semicolon>" ";" test "${test}")
        # Commas and brackets are read as parts of a test specification.
        string(REGEX REPLACE "([][,])" "\\\\\\1" specification "${test}")
        add_program_test("${test}" ${label} "${specification}" ${share})
    endforeach()
endforeach()
file(WRITE ${FILE} "${script}")
