#include "experiment/keys/value_read.h"

#include <algorithm>

#include "experiment/keys/toml_order.h"

namespace overt {

namespace {

/// A word that goes into the cells of tables.
ValueResult check_word(const TomlValue& value, const KeyRule& rule, std::string_view name,
                       const std::string& word) {
    const bool is_blank = word.find_first_not_of(' ') == std::string::npos;
    if (!is_blank &&
        std::none_of(word.begin(), word.end(), [](unsigned char character) { return character < 0x20; }))
        return std::nullopt;
    return ValueFault{
        value.place,
        fmt::format("{}.{}: {}", rule.name, name,
                    is_blank ? "the word is empty" : "the word does not go into one cell of a table"),
        "take letters, digits and signs on one line"};
}

} // namespace

ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedShares& out) {
    if (!value.table())
        return wrong_kind<NamedShares>(value, rule);
    for (const TomlEntry& entry : *value.table()) {
        if (ValueResult fault = check_name(entry.key, entry.key_place, rule.name))
            return fault;
        double number = 0.0;
        if (ValueResult fault = read_value(entry.value, rule, number))
            return fault;
        out.emplace_back(entry.key, number);
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedNumbers& out) {
    if (!value.table())
        return wrong_kind<NamedNumbers>(value, rule);
    for (const TomlEntry* written : in_order_of_file(*value.table())) {
        const TomlEntry& entry = *written;
        NamedNumber& named = out.emplace_back(NamedNumber{entry.key});
        if (ValueResult fault = read_value(entry.value, rule, named.number))
            return fault;
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, NamedWords& out) {
    if (!value.table())
        return wrong_kind<NamedWords>(value, rule);
    for (const TomlEntry* written : in_order_of_file(*value.table())) {
        const TomlEntry& entry = *written;
        NamedWord& named = out.emplace_back(NamedWord{entry.key, {}, {}});
        if (const auto* word = std::get_if<std::string>(&entry.value.content)) {
            if (ValueResult fault = check_word(entry.value, rule, entry.key, *word))
                return fault;
            named.text = *word;
            continue;
        }
        double number = 0.0;
        const bool is_number = std::holds_alternative<double>(entry.value.content) ||
                               std::holds_alternative<std::int64_t>(entry.value.content);
        if (!is_number)
            return ValueFault{entry.value.place, fmt::format("{}.{}: expected a word or a number, found {}",
                                                             rule.name, entry.key, entry.value.kind())};
        if (ValueResult fault = read_value(entry.value, rule, number))
            return fault;
        named.text = fmt::format("{}", number);
        named.number = number;
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Series& out) {
    if (!value.table())
        return wrong_kind<Series>(value, rule);
    for (const TomlEntry* written : in_order_of_file(*value.table()))
        out.keys.push_back(written->key);
    return std::nullopt;
}

} // namespace overt
