#include "experiment/record/stimulus_columns.h"

#include <fmt/format.h>

namespace overt {

namespace {

std::string joined(const auto& of_list) {
    std::string text;
    for (const StimulusList& list : stimulus_lists)
        text += (text.empty() ? "" : ", ") + of_list(list);
    return text;
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

} // namespace

std::string stimulus_columns() {
    return joined([](const StimulusList& list) { return std::string(list.name); });
}

std::string stimulus_columns_of(const SQLite::Database& database, const char* table) {
    return joined([&](const StimulusList& list) {
        std::string name(list.name);
        return has_column(database, table, name.c_str()) ? name : std::string("0");
    });
}

std::string marks_of_stimulus() {
    std::string marks;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        marks += ",?";
    return marks;
}

std::string with_stimulus_columns(std::string sql) {
    replace_all(sql, "@stimulus", joined([](const StimulusList& list) {
                    return fmt::format("{} INTEGER NOT NULL DEFAULT 0", list.name);
                }));
    replace_all(sql, "@indices", stimulus_columns());
    return sql;
}

} // namespace overt
