#include "experiment/keys/key_walk.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

/// The headings of all sections that have a key of this name, but for one.
std::vector<std::string> homes_of(const KeyTable& table, std::string_view key, std::string_view but = {}) {
    std::vector<std::string> homes;
    for (const Section& section : table) {
        if (section.find_key(key) && section.name != but)
            homes.push_back(section.heading());
    }
    return homes;
}

/// Of a key before the first heading: the headings below which there is one of its name.
std::string hint_for_stray_key(const KeyTable& table, std::string_view key) {
    constexpr std::size_t most_homes = 4;
    const std::vector<std::string> homes = homes_of(table, key);
    if (homes.empty() || homes.size() > most_homes)
        return "write it below the heading of its section";
    return fmt::format("write it below the heading {}", fmt::join(homes, " or "));
}

/// Of a key that the section, or the table within one, has not: the nearest that it has, or else where this
/// very key is at home.
std::string hint_for_unknown_key(const KeyTable& table, std::string_view key, const Section& section) {
    if (!key.empty() && key == table.key_above_sections())
        return fmt::format("\"{}\" stands before the first section", key);
    std::vector<std::string_view> names;
    for (const Key& row : section.keys)
        names.push_back(row.rule.name);
    for (const Section& inner : section.tables)
        names.push_back(inner.name);
    const std::vector<std::string> homes = homes_of(table, key, section.name);
    return homes.empty() || nearest_name(key, names)
               ? suggest_name(key, names)
               : fmt::format("\"{}\" belongs to {}", key, homes.front());
}

} // namespace

void KeyWalk::read_root(const TomlFile& toml, void* root) {
    is_whole_ = toml.is_whole;
    for (const TomlEntry& entry : toml.root) {
        if (std::ranges::none_of(table_,
                                 [&](const Section& section) { return section.is_called(entry.key); }))
            report_unknown_section(entry);
    }
    for (const Section& section : table_) {
        const TomlValue* value = value_of(section, toml.root);
        if (section.is_list())
            read_list(section, value, root);
        else
            read_one(section, value, root);
    }
}

const TomlValue* KeyWalk::value_of(const Section& section, const TomlTable& root) {
    const TomlEntry* found = nullptr;
    heading_ = section.name;
    for (const TomlEntry& entry : root) {
        if (!section.is_called(entry.key))
            continue;
        if (found)
            error(std::max(found->key_place, entry.key_place),
                  fmt::format("[{}] and [[{}]] are the same list, and both are written", section.alone,
                              section.name),
                  fmt::format("write [[{}]] for each entry", section.name));
        else
            found = &entry;
    }
    if (!found)
        return nullptr;
    heading_ = found->key;
    return &found->value;
}

void KeyWalk::report_unknown_section(const TomlEntry& entry) {
    if (!entry.value.table() && !entry.value.list()) {
        error(entry.key_place, fmt::format("key \"{}\" stands outside all sections", entry.key),
              hint_for_stray_key(table_, entry.key));
        return;
    }
    std::vector<std::string_view> names;
    for (const Section& section : table_) {
        names.push_back(section.name);
        if (!section.alone.empty() && section.alone != section.name)
            names.push_back(section.alone);
    }
    error(entry.key_place, fmt::format("unknown section [{}]", entry.key), suggest_name(entry.key, names));
}

void KeyWalk::read_one(const Section& section, const TomlValue* value, void* root) {
    static const TomlTable nothing;
    if (value && !value->table()) {
        error(value->place, fmt::format("{}: expected a section, found {}", section.name, value->kind()),
              fmt::format("write [{}] on a line of its own, and its keys below", section.name));
        return;
    }
    if (value)
        places_.note(std::string(section.name), value->place);
    read_keys(section, heading_, value ? *value->table() : nothing, std::string(section.name),
              section.home.open(root));
}

void KeyWalk::read_list(const Section& section, const TomlValue* value, void* root) {
    if (!section.alone.empty() && !(value && value->list())) {
        section.home.clear(root);
        read_entry(section, value, fmt::format("{}[0]", section.name), root);
        return;
    }
    if (!value)
        return;
    if (!value->list()) {
        error(value->place, fmt::format("{}: expected a list of sections", section.name),
              fmt::format("write [[{}]], with two brackets", section.name));
        faulty_.insert(std::string(section.name));
        return;
    }
    if (!section.alone.empty())
        section.home.clear(root);
    for (std::size_t i = 0; i < value->list()->size(); ++i)
        read_entry(section, &(*value->list())[i], fmt::format("{}[{}]", section.name, i), root);
}

void KeyWalk::read_entry(const Section& section, const TomlValue* value, const std::string& path,
                         void* root) {
    static const TomlTable nothing;
    void* const entry = section.home.open(root);
    if (value)
        places_.note(path, value->place);
    if (value && !value->table())
        error(value->place, fmt::format("{}: expected a section, found {}", heading_, value->kind()));
    else
        read_keys(section, heading_, value ? *value->table() : nothing, path, entry);
}

void KeyWalk::read_keys(const Section& section, std::string_view heading, const TomlTable& table,
                        const std::string& path, void* out) {
    for (const TomlEntry& entry : table) {
        const Key* const key = section.find_key(entry.key);
        const auto inner = std::ranges::find(section.tables, entry.key, &Section::name);
        const std::string entry_path = path + "." + entry.key;
        // A key may be written as a value, or as a table of its own.
        const bool is_inner = inner != section.tables.end() && (!key || entry.value.table());
        if (key && !is_inner)
            read_key(*key, entry.value, entry_path, out);
        else if (is_inner)
            read_inner(*inner, entry, entry_path, out);
        else
            error(entry.key_place, fmt::format("unknown key \"{}\" in [{}]", entry.key, heading),
                  hint_for_unknown_key(table_, entry.key, section));
    }
    for (const Key& key : section.keys) {
        if (key.rule.is_required && is_whole_ &&
            !places_.is_written(fmt::format("{}.{}", path, key.rule.name)))
            report_missing(section, key.rule, path);
    }
}

void KeyWalk::read_inner(const Section& section, const TomlEntry& entry, const std::string& path, void* out) {
    places_.note(path, entry.value.place);
    const SectionHome& home = section.home;
    if (home.is_list()) {
        read_inner_list(section, entry, path, out);
    } else if (!entry.value.table()) {
        error(entry.value.place,
              fmt::format("{}: expected a table, found {}", section.name, entry.value.kind()),
              fmt::format(fmt::runtime(home.is_by_name() ? "write {} = {{ NAME = {{ {} = … }} }}"
                                                         : "write {} = {{ {} = … }}"),
                          section.name, section.keys.front().rule.name));
    } else if (home.is_by_name()) {
        for (const TomlEntry& named : *entry.value.table())
            read_named(section, named, fmt::format("{}.{}", path, named.key), out);
    } else {
        void* const inner = home.is_one_by_name() ? home.open_named(out, entry.key)
                            : home.has_struct()   ? home.open(out)
                                                  : out;
        read_keys(section, section.name, *entry.value.table(), path, inner);
    }
}

/// `[[task.answer]]`: it belongs to the [[task]] that stands last before it.
void KeyWalk::read_inner_list(const Section& section, const TomlEntry& entry, const std::string& path,
                              void* out) {
    if (!entry.value.list()) {
        error(entry.value.place,
              fmt::format("{}: expected a list of sections, found {}", section.name, entry.value.kind()),
              fmt::format("write [[{}.{}]], with two brackets", heading_, section.name));
        faulty_.insert(path);
        return;
    }
    const TomlList& entries = *entry.value.list();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        void* const inner = section.home.open(out);
        const std::string entry_path = fmt::format("{}[{}]", path, i);
        places_.note(entry_path, entries[i].place);
        if (entries[i].table())
            read_keys(section, fmt::format("{}.{}", heading_, section.name), *entries[i].table(), entry_path,
                      inner);
        else
            error(entries[i].place,
                  fmt::format("{}: expected a section, found {}", section.name, entries[i].kind()));
    }
}

void KeyWalk::read_named(const Section& section, const TomlEntry& entry, const std::string& path, void* out) {
    places_.note(path, entry.key_place);
    if (const ValueResult fault = check_name(entry.key, entry.key_place, section.name)) {
        error(fault->place, fault->message, fault->hint);
    } else if (!entry.value.table()) {
        error(entry.value.place, fmt::format("{}: expected a table, found {}", entry.key, entry.value.kind()),
              fmt::format("write {} = {{ {} = … }}", entry.key, section.keys.front().rule.name));
    } else {
        read_keys(section, entry.key, *entry.value.table(), path, section.home.open_named(out, entry.key));
        return;
    }
    faulty_.insert(path);
}

void KeyWalk::read_key(const Key& key, const TomlValue& value, const std::string& path, void* out) {
    places_.note(path, value.place);
    if (value.table())
        for (const TomlEntry& entry : *value.table())
            places_.note(path + "." + entry.key, entry.value.place);
    if (const ValueResult fault = key.type->read(value, key.rule, key.place.in(out))) {
        error(fault->place, fault->message, fault->hint);
        for (const ValueFault& further : fault->more)
            error(further.place, further.message, further.hint);
        faulty_.insert(path);
    }
}

void KeyWalk::report_missing(const Section& section, const KeyRule& rule, const std::string& path) {
    error(places_.of(path), fmt::format("{} has no \"{}\"", section.heading(), rule.name),
          std::string(rule.explanation));
    faulty_.insert(fmt::format("{}.{}", path, rule.name));
}

} // namespace overt
