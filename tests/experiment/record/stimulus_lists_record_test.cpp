/// What a record and its tables have of the lists that stimuli are made of, and of their columns.
#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/shared_columns.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

namespace {

/// The example with two lights and columns.
SessionHeader with_lists() {
    SessionHeader header = example_header();
    header.lights = {{.id = "hall", .title = "A hall", .columns = {{"contrast", "0.5", 0.5}}},
                     {.id = "sky", .title = "Sky", .columns = {{"contrast", "0.25", 0.25}}}};
    header.materials[0].columns = {{"gloss", "high", std::nullopt}};
    header.objects[1].columns = {{"size_cm", "12", 12.0}};
    header.schedule.trials[1].stimulus.light = 1;
    header.stimuli.push_back({{1, 0, 1}, "rendered", std::string(64, 'f')});
    return header;
}

} // namespace

TEST_CASE("lists, columns and the light of each planned trial come back from the record", "[unit]") {
    const TemporaryFolder folder;
    const SessionHeader header = with_lists();
    const SessionRecord record(make_session(folder.path(), header));
    const SessionHeader& read = record.header();
    REQUIRE(read.lights.size() == 2);
    CHECK(read.lights[1].id == "sky");
    CHECK(read.lights[1].title == "Sky");
    CHECK(read.lights[0].columns == header.lights[0].columns);
    CHECK(read.materials[0].columns == header.materials[0].columns);
    CHECK(read.objects[0].columns.empty());
    CHECK(read.objects[1].columns == header.objects[1].columns);
    CHECK(read.schedule.trials == header.schedule.trials);
    CHECK(read.stimuli.size() == 3);
    REQUIRE(read.motions.size() == 1); // a header without any has one
    CHECK(read.motions[0].id == "motion");
    CHECK(stimulus_name(read, {1, 0, 1}) == "vase/gold/sky");
    const Factors factors = factors_of(read);
    CHECK(factors.at("contrast").levels == std::vector<FactorLevel>{{"0.25", 0.25}, {"0.5", 0.5}});
    CHECK(factors.at("size_cm").levels == std::vector<FactorLevel>{{"12", 12.0}, {"n/a"}});
}

TEST_CASE("tables have a column for each list with several entries and for each column, with its levels",
          "[unit]") {
    std::vector<std::string> names;
    for (const StimulusColumn& column : stimulus_columns_of(with_lists()))
        names.push_back(column.what.name);
    CHECK(names == std::vector<std::string>{"object", "material", "light", "size_cm", "gloss", "contrast"});
    const auto columns = stimulus_columns_of(with_lists());
    CHECK(columns[2].what.levels ==
          std::vector<std::pair<std::string, std::string>>{{"hall", "A hall"}, {"sky", "Sky"}});
    const Stimulus stimulus{1, 0, 1};
    const auto cell = [&](std::size_t i, TableFormat format) {
        return level_cell(columns[i].level_of(stimulus), format);
    };
    CHECK(cell(2, TableFormat::tsv) == "sky");
    CHECK(cell(3, TableFormat::jsonl) == "12");
    CHECK(cell(4, TableFormat::jsonl) == "\"high\"");
    CHECK(cell(5, TableFormat::csv) == "0.25");
    CHECK(level_cell(columns[3].level_of({0, 0, 0}), TableFormat::jsonl) == "null");
    names.clear();
    for (const StimulusColumn& column : stimulus_columns_of(example_header()))
        names.push_back(column.what.name);
    CHECK(names == std::vector<std::string>{"object", "material"});
}

TEST_CASE("an index that leads out of a list, and a column of an entry that is not there, are damage",
          "[unit]") {
    const TemporaryFolder folder;
    const auto damaged = [&](const char* sql) {
        const auto session =
            make_session(folder.path() / std::to_string(std::hash<std::string>()(sql)), with_lists());
        SQLite::Database(session.string() + "/session.sqlite", SQLite::OPEN_READWRITE).exec(sql);
        CHECK_THROWS_AS(SessionRecord(session), RecordError);
    };
    damaged("UPDATE schedule SET light = 2 WHERE trial = 0");
    damaged("UPDATE entry_column SET entry = 7 WHERE list = 'light' AND entry = 0");
}
