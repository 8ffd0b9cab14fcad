#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"
#include "experiment/record/tables/export_tables.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;

namespace {

nlohmann::json samples_dictionary(const SessionHeader& header) {
    const auto dictionary = nlohmann::json::parse(table_dictionary(ExportTables(header), TableFormat::tsv));
    return dictionary["Files"]["samples.tsv"]["Columns"];
}

} // namespace

TEST_CASE("lengths in tables are millimetres, and the dictionary says so", "[unit]") {
    const nlohmann::json columns = samples_dictionary(example_header());
    for (const char* column : {"surface_x", "surface_y", "surface_z", "depth"}) {
        CHECK(columns[column]["Units"] == "mm");
        CHECK_THAT(columns[column]["Description"].get<std::string>(), !Contains("unit"));
    }
}

TEST_CASE("an object whose unit is unknown is named in the dictionary", "[unit]") {
    SessionHeader header = example_header();
    header.objects[1].unit = "own";
    const nlohmann::json some = samples_dictionary(header);
    CHECK(some["surface_x"]["Units"] == "mm, or as the description says");
    CHECK_THAT(some["depth"]["Description"].get<std::string>(), Contains("of vase in the unit of the mesh"));
    header.objects[0].unit = "own";
    CHECK(samples_dictionary(header)["surface_x"]["Units"] == "as the description says");
}

TEST_CASE("a session of a program that did not write the unit down claims no millimetres", "[unit]") {
    const TemporaryFolder root;
    const std::filesystem::path session = make_session(root.path(), example_header());
    CHECK(SessionRecord(session).header().objects[0].unit == "mm");
    SQLite::Database(session / session_file_name, SQLite::OPEN_READWRITE)
        .exec("ALTER TABLE object DROP COLUMN unit");
    const SessionRecord record(session);
    CHECK(record.header().objects[0].unit.empty());
    const nlohmann::json columns = samples_dictionary(record.header());
    CHECK(columns["surface_z"]["Units"] == "as the description says");
    CHECK_THAT(
        columns["surface_z"]["Description"].get<std::string>(),
        Contains("of bust, vase in millimetres if the protocol names the unit of the mesh, else in that"));
}
