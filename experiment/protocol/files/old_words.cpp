#include "experiment/protocol/files/old_words.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "experiment/base/counted.h"

namespace overt {
namespace {

constexpr std::string_view old_word = "sculpture", word_of_today = "object";

struct Word {
    std::string_view old_word, word;
};
/// Names of sections and keys.
constexpr Word old_names[] = {{"sculpture", "object"},
                              {"sculptures", "objects"},
                              {"max_sculpture_run", "max_object_run"},
                              {"min_sculpture_distance", "min_object_distance"}};

/// Values of a key that begin with a word of overt's own.
struct ValueWord {
    std::string_view key, old_word, word;
};
constexpr ValueWord values[] = {{"by", "sculpture", "object"},
                                {"stimuli", "once-per-sculpture", "once-per-object"},
                                {"condition_codes", "sculpture ", "object "}};

class Reword {
  public:
    Reword(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

    void go_through(TomlTable& table) {
        std::set<std::string> twice;
        for (const TomlEntry& entry : table)
            if (is_there_twice(entry, table))
                twice.insert(entry.key);
        std::erase_if(table, [&](const TomlEntry& entry) { return twice.contains(entry.key); });
        for (TomlEntry& entry : table) {
            const auto found = std::ranges::find(old_names, entry.key, &Word::old_word);
            if (found != std::end(old_names)) {
                count(entry.key_place);
                entry.key = found->word;
            }
            go_through(entry.value, entry.key);
        }
    }

    void note() const {
        if (!first_)
            return;
        diagnostics_.note(
            file_, *first_,
            fmt::format("\"{}\" is the earlier word for \"{}\"; it is read as that, here{}", old_word,
                        word_of_today,
                        places_ > 1 ? fmt::format(" and in {}", counted(places_ - 1, "other place")) : ""),
            fmt::format("write \"{}\" in headings, keys and names of factors", word_of_today));
    }

  private:
    /// Reports an entry that stands there under the word of today, too.
    bool is_there_twice(const TomlEntry& entry, const TomlTable& table) {
        const auto found = std::ranges::find(old_names, entry.key, &Word::old_word);
        if (found == std::end(old_names) ||
            std::ranges::find(table, found->word, &TomlEntry::key) == table.end())
            return false;
        diagnostics_.error(file_, entry.key_place,
                           fmt::format("\"{}\" is the earlier word for \"{}\", which is written, too",
                                       entry.key, found->word),
                           fmt::format("write \"{}\" in all places", found->word));
        return true;
    }

    void go_through(TomlValue& value, std::string_view key) {
        if (auto* table = std::get_if<TomlTable>(&value.content))
            go_through(*table);
        if (auto* list = std::get_if<TomlList>(&value.content))
            for (TomlValue& item : *list)
                go_through(item, key);
        if (auto* text = std::get_if<std::string>(&value.content))
            for (const ValueWord& word : values)
                if (key == word.key && text->starts_with(word.old_word)) {
                    text->replace(0, word.old_word.size(), word.word);
                    count(value.place);
                }
    }

    void count(Place place) {
        ++places_;
        if (!first_ || place < *first_)
            first_ = place; // the tree has its keys in another order than the file
    }

    const std::string& file_;
    Diagnostics& diagnostics_;
    std::optional<Place> first_;
    int places_ = 0;
};

} // namespace

std::string todays_factor(std::string name) { return name == old_word ? std::string(word_of_today) : name; }

void put_todays_words(TomlFile& toml, const std::string& file, Diagnostics& diagnostics) {
    Reword reword(file, diagnostics);
    reword.go_through(toml.root);
    reword.note();
}

void take_out_libraries(TomlFile& toml, const std::string& file, Diagnostics& diagnostics) {
    constexpr std::string_view sections[] = {"tracker", "further_tracker", "marker_output"};
    const auto take_out = [&](TomlTable& table) {
        std::erase_if(table, [&](const TomlEntry& entry) {
            if (entry.key != "library")
                return false;
            diagnostics.warning(
                file, entry.key_place, "a protocol does not name libraries: this one is not loaded from here",
                "leave the line out; where the library does not lie where the system looks, name it with "
                "--library, such as --library lsl=FILE, or in the environment (docs/trust.md)");
            return true;
        });
    };
    for (TomlEntry& entry : toml.root) {
        if (std::ranges::find(sections, entry.key) == std::end(sections))
            continue;
        if (auto* table = std::get_if<TomlTable>(&entry.value.content))
            take_out(*table);
        if (auto* list = std::get_if<TomlList>(&entry.value.content))
            for (TomlValue& item : *list)
                if (auto* table = std::get_if<TomlTable>(&item.content))
                    take_out(*table);
    }
}

} // namespace overt
