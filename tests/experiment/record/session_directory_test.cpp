#include "experiment/record/session_directory.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/observer_label.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_lock.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("sessions of an observer are numbered on, and none is overwritten", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const SessionPlace place{root.path() / "sessions", "tiny", "AB7"};
    CHECK(next_session_number(place) == 1);
    CHECK(make_session(place.root, header) == place.root / "tiny" / "sub-AB7_ses-01");
    CHECK(make_session(place.root, header) == place.root / "tiny" / "sub-AB7_ses-02");
    CHECK(next_session_number({place.root, "tiny", "AB"}) == 1);
    CHECK_THROWS_WITH(SessionDirectory(place, 1), Contains("exists already") && Contains("number is 3"));
    CHECK_THROWS_AS(SessionDirectory(place, 2), InputError);
    CHECK_THROWS_AS(SessionDirectory(place, 0), InputError);
    CHECK(SessionDirectory(place, 12).session_number() == 12);
}

TEST_CASE("labels that differ in case or leading zeros only are alike, and no others", "[unit]") {
    for (const auto& [a, b] :
         {std::pair{"1", "01"}, {"7", "007"}, {"P07", "p7"}, {"a01b2", "A1B002"}, {"0", "00"}}) {
        INFO(a << " " << b);
        CHECK(are_alike(a, b));
        CHECK(are_alike(b, a));
        CHECK_FALSE(are_alike(a, a));
    }
    for (const auto& [a, b] :
         {std::pair{"1", "10"}, {"P1", "Q1"}, {"100", "1"}, {"P10", "P1"}, {"a0", "a"}, {"1a", "a1"}})
        CHECK_FALSE(are_alike(a, b));
}

TEST_CASE("an observer whose label is nearly another's has no place unless that is another person",
          "[unit]") {
    const TemporaryFolder root;
    make_session(root.path(), example_header()); // of AB7
    SessionPlace place{root.path(), "tiny", "ab07"};
    CHECK_THROWS_WITH(check_session_place(place, {}),
                      Catch::Matchers::StartsWith("Observer ab07: " + (root.path() / "tiny").string() +
                                                  " has sessions of observer AB7, and") &&
                          Contains("--observer AB7") && Contains("--another-person"));
    place.is_another_person = true;
    CHECK_NOTHROW(check_session_place(place, {}));
    // Who has a session already goes on under this label.
    SessionHeader header = example_header();
    header.schedule.observer.label = "ab07";
    make_session(root.path(), header);
    place.is_another_person = false;
    CHECK_NOTHROW(check_session_place(place, {}));
    CHECK_NOTHROW(check_session_place({root.path(), "tiny", "AB8"}, {}));
    CHECK_NOTHROW(check_session_place({root.path(), "other", "ab07"}, {}));
}

TEST_CASE("names that would not make one folder are refused", "[unit]") {
    const TemporaryFolder root;
    for (const char* label : {"", "a b", "../x", "sub-1", "ä"})
        CHECK_THROWS_AS(session_path({root.path(), "tiny", label}, 1), InputError);
    for (const char* name : {"", "a/b", "..", ".hidden", "a b"})
        CHECK_THROWS_AS(session_path({root.path(), name, "1"}, 1), InputError);
}

TEST_CASE("a session that was never published leaves nothing behind", "[unit]") {
    const TemporaryFolder root;
    const SessionPlace place{root.path(), "tiny", "1"};
    {
        const SessionDirectory directory(place);
        create_session_file(directory.session_file(), example_header());
        CHECK(fs::exists(directory.session_file()));
        CHECK_FALSE(fs::exists(session_path(place, 1)));
        CHECK(next_session_number(place) == 2);
        CHECK_THROWS_AS(create_session_file(directory.session_file(), example_header()), RecordError);
    }
    CHECK(next_session_number(place) == 1);
    CHECK(fs::is_empty(root.path() / "tiny"));
}

TEST_CASE("of sessions made at once each has a number of its own, and one that is being made is refused",
          "[unit]") {
    const TemporaryFolder root;
    const SessionPlace place{root.path(), "tiny", "1"};
    SessionDirectory first(place), second(place);
    CHECK(first.session_number() == 1);
    CHECK(second.session_number() == 2);
    CHECK_THROWS_WITH(SessionDirectory(place, 1), Contains("another program") && Contains("number is 3"));
    create_session_file(second.session_file(), example_header());
    second.publish();
    CHECK_THROWS_WITH(SessionDirectory(place, 2), Contains("exists already") && Contains("number is 3"));
    first.abandon();
    CHECK(SessionRecord(second.path()).header().protocol.name == "tiny");
}

TEST_CASE("what a killed program left of a session is no hindrance, and goes with the next one", "[unit]") {
    const TemporaryFolder root;
    const SessionPlace place{root.path(), "tiny", "1"};
    const fs::path remnant = root.path() / "tiny/.sub-1_ses-01.partial-a1b2c3";
    const fs::path of_another = root.path() / "tiny/.sub-12_ses-01.partial-a1b2c3";
    fs::create_directories(remnant / "meshes");
    fs::create_directories(of_another);
    CHECK(next_session_number(place) == 1);
    CHECK(SessionDirectory(place).session_number() == 1);
    CHECK_FALSE(fs::exists(remnant));
    CHECK(fs::exists(of_another));
}

TEST_CASE("names are asked for wherever folders are looked for, and labels are as long as may be", "[unit]") {
    const TemporaryFolder root;
    for (const char* const name : {"../tiny", "", ".tiny", "a/b", "a b"}) {
        CAPTURE(name);
        CHECK_THROWS_AS(session_numbers({root.path(), name, "1"}), InputError);
        CHECK_THROWS_AS(session_path({root.path(), name, "1"}, 1), InputError);
        CHECK_THROWS_AS(check_session_place({root.path(), name, "1"}, {}), InputError);
    }
    for (const char* const name : {"tiny", "a.b", "a_b-c", "A9"})
        CHECK(session_numbers({root.path(), name, "1"}).empty());
    CHECK_NOTHROW(check_observer_label(std::string(40, 'a')));
    CHECK_THROWS_WITH(check_observer_label(std::string(41, 'a')),
                      Catch::Contains("41 characters are too many; 40"));
    CHECK_THROWS_AS(check_observer_label(""), InputError);
    CHECK_THROWS_AS(check_observer_label("a_b"), InputError);
}

TEST_CASE("whatever else lies beside sessions, each like-named observer of them is told", "[unit]") {
    const TemporaryFolder root;
    const fs::path folder = root.path() / "tiny";
    for (const char* const name : {"sub-07_ses-01", "sub-7_ses-02", "sub-8_ses-01", "notes", "sub-007",
                                   "x_ses-01", ".sub-0007_ses-01", "ssub-00007_ses-01"})
        fs::create_directories(folder / name);
    CHECK_THROWS_WITH(check_session_place({root.path(), "tiny", "0007"}, {}),
                      Catch::Contains("has sessions of observer 07, 7, and") &&
                          Catch::Contains("--observer 07"));
    CHECK_NOTHROW(check_session_place({root.path(), "tiny", "7"}, {}));
    CHECK_NOTHROW(check_session_place({root.path(), "tiny", "9"}, {}));
    CHECK_NOTHROW(check_session_place({root.path(), "tiny", "0007", true}, {}));
    CHECK_THROWS_WITH(check_session_place({root.path(), "tiny", "7"}, 2), Catch::Contains("exists already"));
    CHECK_NOTHROW(check_session_place({root.path(), "tiny", "7"}, 1));
    for (const char* const name : {"sub-7_ses-10", "sub-7_ses-3x", "sub-7_ses-"})
        fs::create_directories(folder / name);
    CHECK(session_numbers({root.path(), "tiny", "7"}) == std::vector<int>{2, 10});
    CHECK(next_session_number({root.path(), "tiny", "7"}) == 11);
    CHECK(next_session_number({root.path(), "tiny", "9"}) == 1);
    CHECK_THROWS_WITH(SessionDirectory({root.path(), "tiny", "9"}, 0),
                      Catch::Contains("numbers count from 1"));
    CHECK_NOTHROW(SessionDirectory({root.path(), "tiny", "9"}, 1));
    std::ofstream(root.path() / "file") << "x";
    CHECK_THROWS_WITH(check_session_place({root.path() / "file", "tiny", "9"}, {}),
                      Catch::Contains("it is no folder"));
    CHECK_NOTHROW(check_session_place({root.path() / "not/there/yet", "tiny", "9"}, {}));
}

TEST_CASE("a session has one writer, and where there is none it is said", "[unit]") {
    const TemporaryFolder root;
    CHECK_THROWS_WITH(SessionLock(root.path() / "none"), Contains("none: there is no session here."));
    const SessionLock first(root.path());
    CHECK_THROWS_WITH(SessionLock(root.path()), Contains("another program is running this session"));
}
