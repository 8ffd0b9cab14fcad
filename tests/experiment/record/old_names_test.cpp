#include "experiment/record/old_names.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

SQLite::Database with_old_tables() {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("CREATE TABLE sculpture (sculpture INTEGER PRIMARY KEY, id TEXT);"
                  "CREATE TABLE trial (trial INTEGER PRIMARY KEY, sculpture INTEGER, material INTEGER);"
                  "CREATE TABLE material (material INTEGER PRIMARY KEY, id TEXT);"
                  "CREATE VIEW counted_trial AS SELECT * FROM trial WHERE material = 1;"
                  "INSERT INTO sculpture VALUES (0, 'bust'), (1, 'vase');"
                  "INSERT INTO trial VALUES (0, 1, 1), (1, 0, 0)");
    return database;
}

} // namespace

TEST_CASE("names of today are found alone and in a list, and others stay", "[unit]") {
    CHECK(todays_name("sculpture") == "object");
    CHECK(todays_name("material") == "material");
    CHECK(todays_names("trial, sculpture, material") == "trial, object, material");
    CHECK(todays_names("sculpture") == "object");
    CHECK(todays_names("on_sculpture, sculptures") == "on_sculpture, sculptures");
    CHECK(todays_names("").empty());
}

TEST_CASE("tables of an earlier format answer to today's names while they are read, and to their own",
          "[unit]") {
    SQLite::Database database = with_old_tables();
    show_todays_names(database);
    CHECK(database.execAndGet("SELECT id FROM object WHERE object = 1").getString() == "vase");
    CHECK(database.execAndGet("SELECT object FROM trial WHERE trial = 0").getInt() == 1);
    CHECK(database.execAndGet("SELECT object FROM counted_trial").getInt() == 1);
    CHECK(database.execAndGet("SELECT sculpture FROM main.trial WHERE trial = 0").getInt() == 1);
    CHECK(database.execAndGet("SELECT COUNT(*) FROM main.sqlite_schema").getInt() == 4);
    // Those alone that have another name, or a column that has.
    CHECK(
        database
            .execAndGet("SELECT group_concat(name) FROM (SELECT name FROM temp.sqlite_schema ORDER BY name)")
            .getString() == "counted_trial,object,trial");
}

TEST_CASE("renaming in the file keeps rows and the order of columns", "[unit]") {
    SQLite::Database database = with_old_tables();
    rename_to_today(database);
    CHECK(database.execAndGet("SELECT group_concat(name) FROM pragma_table_info('trial')").getString() ==
          "trial,object,material");
    CHECK(database.execAndGet("SELECT group_concat(object || id) FROM object").getString() == "0bust,1vase");
    CHECK(database.execAndGet("SELECT object FROM counted_trial").getInt() == 1);
    rename_to_today(database); // of a file that is of today nothing is left to do
    CHECK(database.execAndGet("SELECT COUNT(*) FROM object").getInt() == 2);
}
