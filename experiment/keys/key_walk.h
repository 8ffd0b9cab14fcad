/// From the tree of a TOML file into structs, by a table of keys.
#pragma once

#include <set>
#include <string>

#include "experiment/base/error.h"
#include "experiment/keys/key_places.h"
#include "experiment/keys/key_table.h"
#include "experiment/keys/toml_tree.h"

namespace overt {

using KeyPaths = std::set<std::string, std::less<>>; ///< as in KeyPlaces

/// Reads a file by a table: notes where each key stands, and finds unknown sections and keys, values that do
/// not fit, and required keys that are lacking. What is wrong goes to the diagnostics; the paths of keys that
/// are, to `faulty`.
class KeyWalk {
  public:
    /// All of them outlive the walk.
    KeyWalk(const KeyTable& table, std::string file, KeyPlaces& places, KeyPaths& faulty,
            Diagnostics& diagnostics)
        : table_(table), file_(std::move(file)), places_(places), faulty_(faulty), diagnostics_(diagnostics) {
    }

    /// `out` is the struct that the table's sections lie in; its lists are empty, but for those whose only
    /// entry may be a section.
    template <class Root> void read(const TomlFile& toml, Root& out) {
        OVERT_EXPECTS(table_.left_out_root() == &as_left_out<Root>());
        read_root(toml, &out);
    }

  private:
    void read_root(const TomlFile& toml, void* root);
    void report_unknown_section(const TomlEntry& entry);
    void read_one(const Section& section, const TomlValue* value, void* root);
    const TomlValue* value_of(const Section& section, const TomlTable& root);
    void read_list(const Section& section, const TomlValue* value, void* root);
    void read_entry(const Section& section, const TomlValue* value, const std::string& path, void* root);
    void read_keys(const Section& section, std::string_view heading, const TomlTable& table,
                   const std::string& path, void* out);
    void read_inner(const Section& section, const TomlEntry& entry, const std::string& path, void* out);
    void read_inner_list(const Section& section, const TomlEntry& entry, const std::string& path, void* out);
    void read_named(const Section& section, const TomlEntry& entry, const std::string& path, void* out);
    void read_key(const Key& key, const TomlValue& value, const std::string& path, void* out);
    void report_missing(const Section& section, const KeyRule& rule, const std::string& path);
    void error(Place place, std::string message, std::string hint = {}) {
        diagnostics_.error(file_, place, std::move(message), std::move(hint));
    }

    const KeyTable& table_;
    std::string file_;
    KeyPlaces& places_;
    KeyPaths& faulty_;
    Diagnostics& diagnostics_;
    std::string_view heading_; ///< as the section that is being read is called in the file
    bool is_whole_ = true;     ///< what is lacking does not lie in lines that were passed over
};

} // namespace overt
