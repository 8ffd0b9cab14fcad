#include "experiment/protocol/protocol_sources.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/path_inside.h"

namespace overt {

namespace {

void stamp(TomlTable& table, int file);

void stamp(TomlValue& value, int file) {
    value.place.file = file;
    if (auto* table = std::get_if<TomlTable>(&value.content))
        stamp(*table, file);
    if (auto* list = std::get_if<TomlList>(&value.content)) {
        for (TomlValue& item : *list)
            stamp(item, file);
    }
}

void stamp(TomlTable& table, int file) {
    for (TomlEntry& entry : table) {
        entry.key_place.file = file;
        stamp(entry.value, file);
    }
}

TomlEntry* find(TomlTable& table, const std::string& key) {
    const auto found = std::ranges::find(table, key, &TomlEntry::key);
    return found == table.end() ? nullptr : &*found;
}

/// Whether a root entry is a [[list]], rather than a value that is a list.
bool is_list_of_tables(const TomlValue& value) {
    return value.list() && !value.list()->empty() && value.list()->front().table();
}

class Joiner {
  public:
    Joiner(const std::filesystem::path& protocol, const IncludeReader& reader, Diagnostics& diagnostics)
        : protocol_(protocol), reader_(reader), diagnostics_(diagnostics) {}

    TomlFile load(std::string_view text, const std::filesystem::path& file, int number) {
        TomlFile own = parse_toml(text, file.string(), diagnostics_);
        stamp(own.root, number);
        open_.push_back(file.lexically_normal());
        TomlTable below;
        const auto include = std::ranges::find(own.root, "include", &TomlEntry::key);
        if (include != own.root.end()) {
            const TomlValue value = std::move(include->value);
            own.root.erase(include);
            own.is_whole = load_all(value, file, below) && own.is_whole;
        }
        open_.pop_back();
        own.root = put_over(std::move(below), std::move(own.root));
        return own;
    }

    std::vector<IncludedText> included;

  private:
    /// False if anything is lacking.
    bool load_all(const TomlValue& value, const std::filesystem::path& file, TomlTable& into) {
        std::vector<TomlValue> names;
        if (std::holds_alternative<std::string>(value.content))
            names = {value};
        else if (value.list())
            names = *value.list();
        bool is_whole = !names.empty();
        for (const TomlValue& name : names)
            is_whole = load_one(name, file, into) && is_whole;
        if (names.empty())
            wrong_kind(file, value);
        return is_whole;
    }

    void wrong_kind(const std::filesystem::path& file, const TomlValue& value) {
        const bool is_empty = std::holds_alternative<std::string>(value.content) || value.list();
        diagnostics_.error(
            file.string(), value.place,
            is_empty ? std::string("include: names no file")
                     : fmt::format("include: expected the path of a file or a list of them, found {}",
                                   value.kind()),
            is_empty ? "leave it out, or write the path from the folder of this file" : "");
    }

    bool load_one(const TomlValue& value, const std::filesystem::path& file, TomlTable& into) {
        const auto* name = std::get_if<std::string>(&value.content);
        if (!name || name->empty()) {
            wrong_kind(file, value);
            return false;
        }
        const std::filesystem::path wanted = (file.parent_path() / *name).lexically_normal();
        if (std::find(open_.begin(), open_.end(), wanted) != open_.end()) {
            std::string way;
            for (const std::filesystem::path& open : open_)
                way += open.filename().string() + " includes ";
            diagnostics_.error(
                file.string(), value.place,
                fmt::format("a file cannot include itself: {}{}", way, wanted.filename().string()));
            return false;
        }
        if (std::ranges::find(included, wanted, &IncludedText::file) != included.end())
            return true;
        UnreadFile why_not;
        const IncludedText* const found =
            text_beside(included, protocol_, wanted, reader_, diagnostics_, why_not);
        if (!found) {
            diagnostics_.error(file.string(), value.place,
                               fmt::format("include \"{}\": {}", *name, why_not.message), why_not.hint);
            return false;
        }
        const int number = found->number;
        const std::string text = found->text; // the list may grow meanwhile
        TomlFile read = load(text, wanted, number);
        put_beside(into, std::move(read.root));
        return read.is_whole;
    }

    std::string name_of(int file) const {
        const auto found = std::ranges::find(included, file, &IncludedText::number);
        return found == included.end() ? "another included file" : found->name;
    }

    /// Of two files side by side neither is above the other.
    void put_beside(TomlTable& table, TomlTable other) {
        for (const TomlEntry& section : other) {
            TomlEntry* known = find(table, section.key);
            if (!known || !section.value.table() || !known->value.table())
                continue;
            for (const TomlEntry& entry : *section.value.table()) {
                auto* earlier = find(std::get<TomlTable>(known->value.content), entry.key);
                if (earlier)
                    diagnostics_.error("", entry.key_place,
                                       fmt::format("{}.{} is set in line {} of {}, too", section.key,
                                                   entry.key, earlier->key_place.line,
                                                   name_of(earlier->key_place.file)),
                                       "set it in the file that includes both, and in neither of them");
            }
        }
        table = put_over(std::move(table), std::move(other));
    }

    static TomlTable put_over(TomlTable below, TomlTable above) {
        for (TomlEntry& entry : above) {
            TomlEntry* known = find(below, entry.key);
            if (!known) {
                below.push_back(std::move(entry));
                continue;
            }
            known->key_place = entry.key_place;
            auto* keys = std::get_if<TomlTable>(&known->value.content);
            auto* more = std::get_if<TomlTable>(&entry.value.content);
            if (keys && more) {
                known->value.place = entry.value.place;
                for (TomlEntry& key : *more) {
                    if (TomlEntry* old = find(*keys, key.key))
                        *old = std::move(key);
                    else
                        keys->push_back(std::move(key));
                }
            } else if (is_list_of_tables(known->value) && is_list_of_tables(entry.value)) {
                auto& entries = std::get<TomlList>(known->value.content);
                for (TomlValue& item : std::get<TomlList>(entry.value.content))
                    entries.push_back(std::move(item));
            } else {
                *known = std::move(entry);
            }
        }
        return below;
    }

    std::filesystem::path protocol_;
    const IncludeReader& reader_;
    Diagnostics& diagnostics_;
    std::vector<std::filesystem::path> open_; ///< files whose includes are being read, outermost first
};

} // namespace

const IncludedText* text_beside(std::vector<IncludedText>& included, const std::filesystem::path& protocol,
                                const std::filesystem::path& file, const IncludeReader& reader,
                                Diagnostics& diagnostics, UnreadFile& why_not) {
    const std::filesystem::path wanted = file.lexically_normal(),
                                folder = protocol.parent_path().lexically_normal();
    // What is read beside a protocol is printed in messages and kept in records, which leave the machine.
    if (!stays_inside(wanted.lexically_proximate(folder).string())) {
        why_not = {"leads out of the protocol's folder",
                   "put the file, or a link to it, into the protocol's folder or one within"};
        return nullptr;
    }
    const auto known = std::ranges::find(included, wanted, &IncludedText::file);
    if (known != included.end())
        return &*known;
    std::optional<std::string> text = reader(wanted, why_not.message);
    if (!text)
        return nullptr;
    const int number = diagnostics.number_of_file(wanted.string());
    diagnostics.quote_from(wanted.string(), *text);
    // Its name is what a record knows it by.
    return &included.emplace_back(IncludedText{wanted.lexically_proximate(protocol.parent_path()).string(),
                                               wanted, *std::move(text), number});
}

JoinedToml read_joined_toml(std::string_view text, const std::filesystem::path& file,
                            const IncludeReader& reader, Diagnostics& diagnostics) {
    Joiner joiner(file, reader, diagnostics);
    TomlFile toml = joiner.load(text, file, 0);
    return {std::move(toml), std::move(joiner.included)};
}

} // namespace overt
