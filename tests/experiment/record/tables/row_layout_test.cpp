/// Tables whose columns a protocol has named as well.
#include "experiment/record/tables/row_layout.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

struct LaidOut {
    int value = 0;
};

std::vector<RowLayout<LaidOut>::Column> columns_called(std::vector<std::string> names, bool is_named) {
    std::vector<RowLayout<LaidOut>::Column> columns;
    for (const std::string& name : names) {
        columns.push_back({{name, "A number"}, &LaidOut::value});
        columns.back().is_named = is_named;
    }
    return columns;
}

} // namespace

TEST_CASE("no two columns of a table have one name, and the table's own keeps it", "[unit]") {
    RowLayout<LaidOut> layout("answers", "A row for each.", columns_called({"trial"}, false));
    layout.add<LaidOut>(columns_called({"place", "trial", "gloss"}, true));
    layout.add<LaidOut>(columns_called({"place"}, false));
    std::vector<std::string> names;
    for (const TableColumn& column : layout.table().columns)
        names.push_back(column.name);
    CHECK(names == std::vector<std::string>{"trial", "own_place", "own_trial", "gloss", "place"});
}
