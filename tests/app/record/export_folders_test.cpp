#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/record/asc/asc_import.h"
#include "tests/support/asc_text.h"
#include "tests/support/running_program.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

TEST_CASE(
    "several sessions are exported to folders of their names, by their protocols where those are the same",
    "[session]") {
    const test::TemporaryFolder root;
    const fs::path file = write_asc(root.path() / "a.asc", asc_text({}));
    for (const char* session : {"faces/sub-01_ses-01", "scenes/sub-01_ses-01", "scenes/sub-02_ses-01"}) {
        AscImportOptions options;
        options.place.observer_label = "01";
        options.out = root.path() / session;
        import_asc(file, options);
    }
    const auto exported = [&](const std::vector<std::string>& sessions, const std::string& out) {
        std::vector<std::string> arguments{"export", "--out", (root.path() / out).string()};
        for (const std::string& session : sessions)
            arguments.push_back((root.path() / session).string());
        return test::RunningProgram(arguments, {}, root.path() / "said").wait();
    };
    // As shells complete them: with a separator at their ends.
    REQUIRE(exported({"scenes/sub-01_ses-01/", "scenes/sub-02_ses-01/"}, "one") == 0);
    CHECK(fs::exists(root.path() / "one/sub-01_ses-01/trials.tsv"));
    CHECK(fs::exists(root.path() / "one/sub-02_ses-01/trials.tsv"));
    // All observers in one table.
    std::ifstream participants(root.path() / "one/participants.tsv");
    std::vector<std::string> lines;
    for (std::string line; std::getline(participants, line);)
        lines.push_back(line);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].starts_with("observer\tsession\tparticipant_id\t"));
    CHECK(lines[1].starts_with("01\t1\tsub-01\t"));
    REQUIRE(exported({"faces/sub-01_ses-01", "scenes/sub-01_ses-01", "scenes/sub-02_ses-01"}, "all") == 0);
    CHECK(fs::exists(root.path() / "all/faces/sub-01_ses-01/trials.tsv"));
    CHECK(fs::exists(root.path() / "all/scenes/sub-01_ses-01/trials.tsv"));
    CHECK(fs::exists(root.path() / "all/sub-02_ses-01/trials.tsv"));
    // Nothing is written where a folder of one of them is taken.
    CHECK(exported({"scenes/sub-01_ses-01", "scenes/sub-02_ses-01"}, "all") == 2);
    CHECK_FALSE(fs::exists(root.path() / "all/sub-01_ses-01"));
}

TEST_CASE("sessions whose folders and protocols have the same names are exported to folders apart",
          "[session]") {
    const test::TemporaryFolder root;
    const fs::path file = write_asc(root.path() / "a.asc", asc_text({}));
    for (const char* of : {"first", "second"}) {
        AscImportOptions options;
        options.place.observer_label = "01";
        options.out = root.path() / "recordings" / of / "imported/sub-01_ses-01";
        import_asc(file, options);
    }
    const std::vector<std::string> arguments{"export", (root.path() / "recordings").string(), "--out",
                                             (root.path() / "tables").string()};
    REQUIRE(test::RunningProgram(arguments, {}, root.path() / "said").wait() == 0);
    CHECK(fs::exists(root.path() / "tables/first/imported/sub-01_ses-01/trials.tsv"));
    CHECK(fs::exists(root.path() / "tables/second/imported/sub-01_ses-01/trials.tsv"));
}
