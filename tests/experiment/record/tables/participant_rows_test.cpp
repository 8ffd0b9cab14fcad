#include "experiment/record/tables/participant_rows.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/table_export.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

TEST_CASE("participants of several sessions are one table: what one session did not ask is missing",
          "[unit]") {
    const TemporaryFolder root;
    const std::vector<ParticipantRow> rows{
        {"07", 1, {{"age", "Age", "31"}, {"glasses", "Glasses?", "yes\tno"}}},
        {"07", 2, {{"slept_h", "Hours slept", "7.5"}}},
        {"08", 1, {}},
    };
    CHECK(write_participants(rows, root.path(), TableFormat::tsv) == root.path() / "participants.tsv");
    CHECK(text_of(root.path() / "participants.tsv") ==
          "observer\tsession\tparticipant_id\tspecies\tage\tsex\thandedness\tglasses\tslept_h\n"
          "07\t1\tsub-07\thomo sapiens\t31\tn/a\tn/a\tyes\\tno\tn/a\n"
          "07\t2\tsub-07\thomo sapiens\tn/a\tn/a\tn/a\tn/a\t7.5\n"
          "08\t1\tsub-08\thomo sapiens\tn/a\tn/a\tn/a\tn/a\tn/a\n");
    write_participants(rows, root.path(), TableFormat::csv);
    CHECK(text_of(root.path() / "participants.csv").starts_with("observer,session,participant_id,"));
    write_participants({rows[2]}, root.path(), TableFormat::jsonl);
    CHECK(text_of(root.path() / "participants.jsonl") ==
          "{\"observer\":\"08\",\"session\":1,\"participant_id\":\"sub-08\",\"species\":\"homo sapiens\","
          "\"age\":null,\"sex\":null,\"handedness\":null}\n");
}

TEST_CASE("a field of the form with the name of another column has a column of its own", "[unit]") {
    const std::vector<ParticipantRow> rows{{"07", 1, {{"session", "Which session?", "evening"}}}};
    const RowLayout<ParticipantRow> layout = participants_layout(rows);
    TableText text(layout.table(), TableFormat::tsv);
    layout.write(text, rows[0]);
    CHECK(layout.table().columns.back().name == "form_session");
    CHECK(text.all() == "07\t1\tsub-07\thomo sapiens\tn/a\tn/a\tn/a\tevening\n");
}

TEST_CASE("every table of a session begins with its observer and its number", "[unit]") {
    const SessionHeader header = example_header();
    const ExportTables tables(header);
    for (const Table* table : tables.all()) {
        const std::vector<TableColumn> columns = table->all_columns();
        CHECK(columns[0].name == "observer");
        CHECK(columns[1].name == "session");
        CHECK(std::count_if(columns.begin(), columns.end(),
                            [](const TableColumn& column) { return column.name == "session"; }) == 1);
    }
    TableText text(tables.events.table(), TableFormat::csv);
    tables.events.write(text, {1, at_ms(5), -1, "calibration", "0.3 deg"});
    CHECK(text.all() == "AB7,3,0.005000000,n/a,calibration,0.3 deg\n");
    TableText object(tables.events.table(), TableFormat::jsonl);
    tables.events.write(object, {1, at_ms(5), 0, "key", "x"});
    CHECK(object.all() == "{\"observer\":\"AB7\",\"session\":3,\"time_s\":0.005000000,\"trial\":1,\"kind\":"
                          "\"key\",\"detail\":\"x\"}\n");
}
