# Run after a test program is linked: writes the CTest script FILE with each of its test cases by name, labelled with its
# one tag out of unit, gl, session and bench. A test case without such a tag stops the build, for nobody would run it; one
# that is tagged [.long] is run by hand (tests/README.md).
function(list_tests spec result)
    execute_process(COMMAND ${PROGRAM} ${spec} --list-test-names-only OUTPUT_VARIABLE names RESULT_VARIABLE count)
    # Catch2 answers with the number of tests; a program that cannot be run answers with words.
    if(NOT count MATCHES "^[0-9]+$")
        message(FATAL_ERROR "${PROGRAM}: its tests cannot be listed: ${count}")
    endif()
    string(STRIP "${names}" names)
    string(REPLACE ";" "\\;" names "${names}")
    string(REPLACE "\n" ";" names "${names}")
    set(${result} "${names}" PARENT_SCOPE)
endfunction()

list_tests("~[unit]~[gl]~[session]~[bench]~[.long]" unlabelled)
if(unlabelled)
    message(FATAL_ERROR "Test cases without a tag [unit], [gl], [session] or [bench]: ${unlabelled}")
endif()

set(script "")
foreach(label unit gl session bench)
    list_tests("[${label}]" tests)
    foreach(test IN LISTS tests)
        # Commas and brackets are read as parts of a test specification.
        string(REGEX REPLACE "([][,])" "\\\\\\1" specification "${test}")
        string(APPEND script "add_test([==[${test}]==] [==[${PROGRAM}]==] [==[${specification}]==])\n"
            "set_tests_properties([==[${test}]==] PROPERTIES LABELS ${label} TIMEOUT 600 "
            "SKIP_REGULAR_EXPRESSION [==[overt test skipped: ]==] "
            "WORKING_DIRECTORY [==[${FOLDER}]==] ENVIRONMENT [==[${ENVIRONMENT}]==])\n")
    endforeach()
endforeach()
file(WRITE ${FILE} "${script}")
