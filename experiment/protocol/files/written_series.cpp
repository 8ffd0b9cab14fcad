#include "experiment/protocol/files/written_series.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/keys/toml_order.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/stimulus_lists.h"

namespace overt {

namespace {

TomlEntry* entry_called(TomlTable& table, std::string_view key) {
    const auto found = std::ranges::find(table, key, &TomlEntry::key);
    return found == table.end() ? nullptr : &*found;
}

bool is_number(const TomlValue& value) {
    return std::holds_alternative<std::int64_t>(value.content) ||
           std::holds_alternative<double>(value.content);
}

/// As ids, titles and tables have it; nothing if it is neither a number nor a word.
std::optional<std::string> text_of_value(const TomlValue& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.content))
        return fmt::format("{}", *whole);
    if (const auto* number = std::get_if<double>(&value.content))
        return fmt::format("{}", *number);
    if (const auto* word = std::get_if<std::string>(&value.content))
        return std::filesystem::path(*word).stem().string(); // of a file: its name without the ending
    return std::nullopt;
}

/// The same where only letters, digits, -, _ and points within may stand.
std::string id_part(std::string text) {
    for (char& character : text)
        if (!std::isalnum(static_cast<unsigned char>(character)) && character != '.' && character != '-')
            character = '_';
    return text;
}

/// By what an entry without an id is called (StimulusList::named_by): the key and its value, or null.
const TomlEntry* naming_key(TomlTable& table, const StimulusList& list) {
    for (const std::string_view key : list.named_by)
        if (const TomlEntry* entry = key.empty() ? nullptr : entry_called(table, key))
            if (std::holds_alternative<std::string>(entry->value.content))
                return entry;
    return nullptr;
}

std::string name_of_entry(TomlTable& table, const StimulusList& list) {
    const TomlEntry* const named = naming_key(table, list);
    const std::string name = named ? id_part(*text_of_value(named->value)) : "";
    return name.empty() ? std::string(list.name) : name;
}

class SeriesWriter {
  public:
    SeriesWriter(const StimulusList& list, const Section& section, const std::string& file,
                 const FilesOfPattern& files_of, Diagnostics& diagnostics)
        : list_(list), section_(section), file_(file), files_of_(files_of), diagnostics_(diagnostics) {}

    /// The entries that stand in an entry's place.
    TomlList written_out(TomlValue entry) {
        auto* table = std::get_if<TomlTable>(&entry.content);
        TomlEntry* series = table ? entry_called(*table, "series") : nullptr;
        if (!series || !series->value.table())
            return {std::move(entry)};
        if (!write_out_patterns(std::get<TomlTable>(series->value.content)))
            return {};
        TomlTable keys;
        for (const TomlEntry* key : in_order_of_file(*series->value.table()))
            keys.push_back(*key);
        if (!is_sound(*table, *series, keys))
            return {std::move(entry)};
        TomlList entries;
        for (std::size_t i = 0; i < keys.front().value.list()->size(); ++i)
            entries.push_back(at(entry, keys, i));
        return entries;
    }

  private:
    /// Lists of files in place of patterns. Of several patterns in a series files of one name belong
    /// together.
    bool write_out_patterns(TomlTable& keys) {
        const TomlEntry* first = nullptr;
        std::string first_written;
        for (TomlEntry& key : keys) {
            const auto* pattern = std::get_if<std::string>(&key.value.content);
            if (!pattern || !is_pattern(*pattern))
                continue;
            const std::optional<std::vector<std::string>> files = files_of_(*pattern, key.value.place);
            if (!files)
                return false;
            TomlList list;
            for (const std::string& name : *files)
                list.push_back({key.value.place,
                                (std::filesystem::path(*pattern).parent_path() / name).generic_string()});
            const std::string written = *pattern;
            key.value.content = std::move(list);
            if (first &&
                !(are_of_one_name(*first, key, written) && are_of_one_name(key, *first, first_written)))
                return false;
            if (!std::exchange(first, first ? first : &key))
                first_written = written;
        }
        return true;
    }

    bool are_of_one_name(const TomlEntry& one, const TomlEntry& other, const std::string& pattern) const {
        for (const TomlValue& file : *one.value.list())
            if (std::ranges::find(*other.value.list(), text_of_value(file), text_of_value) ==
                other.value.list()->end())
                return fault(other.value.place, fmt::format("series.{}: \"{}\" has no file for {}", other.key,
                                                            pattern, *text_of_value(file)));
        return true;
    }

    bool is_sound(TomlTable& table, const TomlEntry& series, const TomlTable& keys) {
        if (keys.empty())
            return fault(series.value.place, "series: names no key",
                         "such as series = { roughness = [0.05, 0.1] }");
        bool are_sound = true;
        for (const TomlEntry& entry : keys)
            are_sound = is_key_sound(table, entry) && are_sound;
        if (!are_sound)
            return false;
        const std::size_t length = keys.front().value.list()->size();
        for (const TomlEntry& entry : keys)
            if (entry.value.list()->size() != length)
                return fault(entry.value.place,
                             fmt::format("series.{} has {}, and series.{} has {}", entry.key,
                                         counted(entry.value.list()->size(), "value"), keys.front().key,
                                         counted(length, "value")),
                             "the first values belong together, then the second, and so on");
        return true;
    }

    bool is_key_sound(TomlTable& table, const TomlEntry& entry) {
        const Key* key = section_.find_key(entry.key);
        std::vector<std::string_view> names;
        for (const Key& known : section_.keys)
            if (takes_series(known))
                names.push_back(known.rule.name);
        if (!key)
            return fault(entry.key_place,
                         fmt::format("unknown key \"{}\" in the series of [{}]", entry.key, section_.name),
                         suggest_name(entry.key, names));
        if (!takes_series(*key))
            return fault(entry.key_place,
                         fmt::format("\"{}\" takes {}: a series is of a number, a word or a file", entry.key,
                                     key->type->noun));
        if (const TomlEntry* own = entry_called(table, entry.key))
            return fault(own->key_place, fmt::format("\"{}\" is set by the series, too", entry.key),
                         "take it out here, or there");
        if (!entry.value.list() || entry.value.list()->empty())
            return fault(entry.value.place,
                         fmt::format("series.{}: expected a list of values, found {}", entry.key,
                                     entry.value.list() ? "an empty one" : entry.value.kind()));
        std::vector<std::string> before;
        for (const TomlValue& value : *entry.value.list()) {
            const std::optional<std::string> text = text_of_value(value);
            if (!text)
                return fault(value.place, fmt::format("series.{}: expected a number or a word, found {}",
                                                      entry.key, value.kind()));
            if (std::ranges::find(before, *text) != before.end())
                return fault(value.place, fmt::format("series.{}: has {} already", entry.key, *text),
                             "two entries would have the same id");
            before.push_back(*text);
        }
        return true;
    }

    static bool takes_series(const Key& key) {
        constexpr std::string_view not_these[] = {"id", "title"};
        constexpr std::string_view nouns[] = {"a number", "a whole number", "a text"};
        return std::ranges::find(not_these, key.rule.name) == std::end(not_these) &&
               std::ranges::find(nouns, key.type->noun) != std::end(nouns);
    }

    TomlValue at(const TomlValue& entry, const TomlTable& keys, std::size_t index) const {
        TomlValue one = entry;
        auto& table = std::get<TomlTable>(one.content);
        std::string ending, words;
        const bool is_called_by_series =
            !entry_called(table, "id") &&
            std::ranges::any_of(keys, [this](const TomlEntry& key) { return names_entry(key); });
        for (const TomlEntry& key : keys) {
            const TomlValue& value = (*key.value.list())[index];
            table.push_back({key.key, key.key_place, value});
            // Files that belong together by their names have one name together.
            if (is_named_as_before(keys, key, index))
                continue;
            ending += "-" + id_part(*text_of_value(value));
            words += " " + *text_of_value(value);
            if (!(is_called_by_series && names_entry(key))) // its values are the ids
                column(table, key, value);
        }
        if (is_called_by_series)
            table.push_back({"id", one.place, {one.place, ending.substr(1)}});
        else
            name_by_list(table, ending, one.place);
        if (TomlEntry* title = entry_called(table, "title"))
            if (auto* text = std::get_if<std::string>(&title->value.content))
                *text += words;
        return one;
    }

    /// Whether a key of the series is one by which entries are called.
    bool names_entry(const TomlEntry& key) const {
        return std::ranges::find(list_.named_by, key.key) != list_.named_by.end();
    }

    static bool is_named_as_before(const TomlTable& keys, const TomlEntry& key, std::size_t index) {
        const TomlEntry& first = keys.front();
        return &key != &first && !is_number((*key.value.list())[index]) &&
               std::ranges::equal(*key.value.list(), *first.value.list(), {}, text_of_value, text_of_value);
    }

    void column(TomlTable& table, const TomlEntry& key, const TomlValue& value) const {
        if (!entry_called(table, "columns"))
            table.push_back({"columns", key.key_place, {key.value.place, TomlTable()}});
        auto* columns = std::get_if<TomlTable>(&entry_called(table, "columns")->value.content);
        if (!columns)
            return; // is no table, and found wrong as what it is
        if (const TomlEntry* own = entry_called(*columns, key.key)) {
            diagnostics_.error(file_, own->key_place,
                               fmt::format("the series makes a column \"{}\", too", key.key),
                               "call this one otherwise");
            return;
        }
        TomlValue content{value.place, value.content};
        if (!is_number(value))
            content.content = *text_of_value(value);
        columns->push_back({key.key, key.key_place, std::move(content)});
    }

    /// Puts an ending behind the id. One left out is the name of a list that may have one entry, or what its
    /// entry is called by.
    void name_by_list(TomlTable& table, const std::string& ending, Place place) const {
        TomlEntry* known = entry_called(table, "id");
        if (!known) {
            const std::string name =
                section_.is_never_empty() ? std::string(list_.name) : name_of_entry(table, list_);
            known = &table.emplace_back(TomlEntry{"id", place, {place, name}});
        }
        if (auto* text = std::get_if<std::string>(&known->value.content))
            *text += ending;
    }

    bool fault(Place place, std::string message, std::string hint = {}) const {
        diagnostics_.error(file_, place, std::move(message), std::move(hint));
        return false;
    }

    const StimulusList& list_;
    const Section& section_;
    const std::string& file_;
    const FilesOfPattern& files_of_;
    Diagnostics& diagnostics_;
};

} // namespace

bool is_pattern(const std::filesystem::path& file) {
    return file.filename().string().find_first_of("*?") != std::string::npos;
}

bool fits_pattern(std::string_view name, std::string_view pattern) {
    if (pattern.empty())
        return name.empty();
    if (pattern.front() == '*')
        return fits_pattern(name, pattern.substr(1)) ||
               (!name.empty() && fits_pattern(name.substr(1), pattern));
    return !name.empty() && (pattern.front() == '?' || pattern.front() == name.front()) &&
           fits_pattern(name.substr(1), pattern.substr(1));
}

void write_out_series(TomlFile& toml, const std::string& file, const FilesOfPattern& files_of,
                      Diagnostics& diagnostics) {
    for (const StimulusList& list : stimulus_lists) {
        const Section& section = protocol_keys().section(list.name);
        SeriesWriter writer(list, section, file, files_of, diagnostics);
        for (TomlEntry& root : toml.root) {
            if (!section.is_called(root.key))
                continue;
            TomlList entries;
            if (root.value.table()) {
                const Place place = root.value.place;
                if (!entry_called(std::get<TomlTable>(root.value.content), "series"))
                    continue;
                entries = writer.written_out(std::move(root.value));
                root.value.place = place;
            } else if (root.value.list()) {
                for (const TomlValue& entry : *root.value.list())
                    for (TomlValue& one : writer.written_out(entry))
                        entries.push_back(std::move(one));
            } else {
                continue;
            }
            root.value.content = std::move(entries);
        }
    }
}

namespace {

void add_id(TomlTable& table, Place place, std::string id) {
    if (!entry_called(table, "id"))
        table.push_back({"id", place, {place, std::move(id)}});
}

/// The only task is "task", others have their numbers.
void name_tasks(TomlFile& toml) {
    TomlEntry* const root = entry_called(toml.root, "task");
    auto* const tasks = root ? std::get_if<TomlList>(&root->value.content) : nullptr;
    for (std::size_t i = 0; tasks && i < tasks->size(); ++i)
        if (auto* const table = std::get_if<TomlTable>(&(*tasks)[i].content))
            add_id(*table, (*tasks)[i].place, tasks->size() == 1 ? "task" : fmt::format("task-{}", i + 1));
}

} // namespace

void name_entries(TomlFile& toml) {
    name_tasks(toml);
    for (const StimulusList& list : stimulus_lists) {
        const Section& section = protocol_keys().section(list.name);
        for (TomlEntry& root : toml.root) {
            auto* const entries = std::get_if<TomlList>(&root.value.content);
            if (!section.is_called(root.key) || !entries ||
                (entries->size() == 1 && section.is_never_empty()))
                continue;
            for (TomlValue& entry : *entries) {
                auto* const table = std::get_if<TomlTable>(&entry.content);
                if (table)
                    add_id(*table, entry.place, name_of_entry(*table, list));
            }
        }
    }
}

} // namespace overt
