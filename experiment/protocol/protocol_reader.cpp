#include "experiment/protocol/protocol_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/protocol/key_hints.h"
#include "experiment/protocol/protocol_keys.h"
#include "experiment/protocol/protocol_sources.h"
#include "experiment/protocol/toml_tree.h"
#include "experiment/protocol/value_reader.h"
#include "experiment/scene/metal_table.h"

namespace overt {

namespace {

/// Walks the table of keys over the tree of a file.
class ProtocolWalk {
  public:
    ProtocolWalk(ProtocolExamination& examination, const TomlFile& toml, Diagnostics& diagnostics)
        : examination_(examination), toml_(toml), diagnostics_(diagnostics),
          file_(examination.protocol.file.string()) {}

    void read() {
        for_each_section([&](const auto& section) { section_names_.push_back(section.name); });
        for (const TomlEntry& entry : toml_.root) {
            if (std::find(section_names_.begin(), section_names_.end(), entry.key) == section_names_.end())
                report_unknown_section(entry);
        }
        for_each_section([&](const auto& section) { read_section(section); });
    }

  private:
    void report_unknown_section(const TomlEntry& entry) {
        const bool is_key = !entry.value.table() && !entry.value.list();
        diagnostics_.error(file_, entry.key_place,
                           is_key ? fmt::format("key \"{}\" stands outside all sections", entry.key)
                                  : fmt::format("unknown section [{}]", entry.key),
                           is_key ? hint_for_stray_key(entry.key) : suggest_name(entry.key, section_names_));
    }

    template <class Struct> void read_section(const Section<Struct>& section) {
        const auto entry =
            std::find_if(toml_.root.begin(), toml_.root.end(),
                         [&](const TomlEntry& candidate) { return candidate.key == section.name; });
        const TomlValue* value = entry == toml_.root.end() ? nullptr : &entry->value;
        if (section.many)
            read_entries(section, value, examination_.protocol.*section.many);
        else if constexpr (std::is_same_v<Struct, Protocol>)
            read_one(section, value, examination_.protocol);
        else
            read_one(section, value, examination_.protocol.*section.one);
    }

    template <class Struct>
    void read_one(const Section<Struct>& section, const TomlValue* value, Struct& out) {
        static const TomlTable nothing;
        if (value && !value->table()) {
            diagnostics_.error(
                file_, value->place,
                fmt::format("{}: expected a section, found {}", section.name, value->kind()),
                fmt::format("write [{}] on a line of its own, and its keys below", section.name));
            return;
        }
        if (value)
            examination_.protocol.places.note(std::string(section.name), value->place);
        read_keys(section, value ? *value->table() : nothing, std::string(section.name), out);
    }

    template <class Struct>
    void read_entries(const Section<Struct>& section, const TomlValue* value, std::vector<Struct>& out) {
        if (!value)
            return;
        if (!value->list()) {
            diagnostics_.error(file_, value->place,
                               fmt::format("{}: expected a list of sections", section.name),
                               fmt::format("write [[{}]], with two brackets", section.name));
            examination_.faulty.insert(std::string(section.name));
            return;
        }
        for (const TomlValue& item : *value->list()) {
            const std::string path = fmt::format("{}[{}]", section.name, out.size());
            examination_.protocol.places.note(path, item.place);
            out.emplace_back();
            if (item.table()) {
                read_keys(section, *item.table(), path, out.back());
            } else {
                diagnostics_.error(
                    file_, item.place,
                    fmt::format("{}: expected a section, found {}", section.name, item.kind()));
            }
        }
    }

    template <class Struct>
    void read_keys(const Section<Struct>& section, const TomlTable& table, const std::string& path,
                   Struct& out) {
        for (const TomlEntry& entry : table) {
            const auto key = std::find_if(section.keys.begin(), section.keys.end(),
                                          [&](const Key<Struct>& k) { return k.rule.name == entry.key; });
            const auto inner = std::find_if(section.tables.begin(), section.tables.end(),
                                            [&](const Section<Struct>& s) { return s.name == entry.key; });
            const std::string entry_path = path + "." + entry.key;
            if (key != section.keys.end())
                read_key(*key, entry, entry_path, out);
            else if (inner != section.tables.end())
                read_inner(*inner, entry, entry_path, out);
            else
                report_unknown_key(section, entry);
        }
        for (const Key<Struct>& key : section.keys) {
            const std::string key_path = fmt::format("{}.{}", path, key.rule.name);
            if (key.rule.is_required && toml_.is_whole && !examination_.is_written(key_path))
                report_missing(section, key.rule, path, key_path);
        }
    }

    template <class Struct>
    void read_inner(const Section<Struct>& section, const TomlEntry& entry, const std::string& path,
                    Struct& out) {
        examination_.protocol.places.note(path, entry.value.place);
        if (entry.value.table()) {
            read_keys(section, *entry.value.table(), path, out);
            return;
        }
        diagnostics_.error(
            file_, entry.value.place,
            fmt::format("{}: expected a table, found {}", section.name, entry.value.kind()),
            fmt::format("write {} = {{ {} = … }}", section.name, section.keys.front().rule.name));
    }

    template <class Struct>
    void read_key(const Key<Struct>& key, const TomlEntry& entry, const std::string& path, Struct& out) {
        examination_.protocol.places.note(path, entry.value.place);
        const ValueResult fault = std::visit(
            [&](auto member) { return read_value(entry.value, key.rule, out.*member); }, key.member);
        if (fault) {
            diagnostics_.error(file_, fault->place, fault->message, fault->hint);
            examination_.faulty.insert(path);
        }
    }

    template <class Struct> void report_unknown_key(const Section<Struct>& section, const TomlEntry& entry) {
        std::vector<std::string_view> names;
        for (const Key<Struct>& key : section.keys)
            names.push_back(key.rule.name);
        for (const Section<Struct>& table : section.tables)
            names.push_back(table.name);
        diagnostics_.error(file_, entry.key_place,
                           fmt::format("unknown key \"{}\" in [{}]", entry.key, section.name),
                           hint_for_unknown_key(entry.key, section.name, names));
    }

    template <class Struct>
    void report_missing(const Section<Struct>& section, const KeyRule& rule, const std::string& path,
                        const std::string& key_path) {
        const std::string heading =
            section.many ? fmt::format("[[{}]]", section.name) : fmt::format("[{}]", section.name);
        diagnostics_.error(file_, examination_.protocol.places.of(path),
                           fmt::format("{} has no \"{}\"", heading, rule.name),
                           std::string(rule.explanation));
        examination_.faulty.insert(key_path);
    }

    ProtocolExamination& examination_;
    const TomlFile& toml_;
    Diagnostics& diagnostics_;
    std::string file_;
    std::vector<std::string_view> section_names_;
};

/// The folder that a path counts from: that of the file in which it stands.
std::filesystem::path folder_of(const Protocol& protocol, std::string_view key_path) {
    if (protocol.places.is_written(key_path)) {
        const int number = protocol.places.of(key_path).file;
        for (const IncludedText& included : protocol.included) {
            if (number != 0 && included.number == number)
                return included.file.parent_path();
        }
    }
    return protocol.file.parent_path();
}

/// Titles left out take the ids; paths become independent of the working directory of whoever reads on.
void complete(Protocol& protocol) {
    if (protocol.title.empty())
        protocol.title = protocol.name;
    for (std::size_t i = 0; i < protocol.observer_fields.size(); ++i)
        complete_field(protocol.observer_fields[i],
                       protocol.places.is_written(fmt::format("observer_field[{}].kind", i)));
    for (std::size_t i = 0; i < protocol.sculptures.size(); ++i) {
        SculptureSettings& sculpture = protocol.sculptures[i];
        const auto folder = folder_of(protocol, fmt::format("sculpture[{}]", i));
        if (sculpture.title.empty())
            sculpture.title = sculpture.id;
        if (!sculpture.mesh.empty())
            sculpture.mesh = folder / sculpture.mesh;
        if (!sculpture.labels.empty())
            sculpture.labels = folder / sculpture.labels;
        if (!sculpture.lut.empty())
            sculpture.lut = (folder / sculpture.lut).string();
    }
    for (std::size_t i = 0; i < protocol.materials.size(); ++i) {
        MaterialSettings& material = protocol.materials[i];
        if (material.title.empty())
            material.title = material.id;
        if (is_metal_file(material.metal))
            material.metal = (folder_of(protocol, fmt::format("material[{}]", i)) / material.metal).string();
    }
    for (std::size_t i = 0; i < protocol.frames.size(); ++i) {
        FrameSequenceSettings& sequence = protocol.frames[i];
        if (!sequence.files.empty())
            sequence.files = (folder_of(protocol, fmt::format("frames[{}]", i)) / sequence.files).string();
    }
    if (!protocol.display.characterisation_file.empty())
        protocol.display.characterisation_file =
            folder_of(protocol, "display.characterisation") / protocol.display.characterisation_file;
    if (protocol.light.probe != "overcast")
        protocol.light.probe = (folder_of(protocol, "light.probe") / protocol.light.probe).string();
}

} // namespace

bool read_written_keys(ProtocolExamination& examination, std::string_view text, const IncludeReader& reader) {
    Protocol& protocol = examination.protocol;
    Diagnostics& diagnostics = examination.diagnostics();
    protocol.text = text;
    diagnostics.quote_from(protocol.file.string(), text);
    JoinedToml joined = read_joined_toml(text, protocol.file, reader, diagnostics);
    protocol.included = std::move(joined.included);
    ProtocolWalk(examination, joined.toml, diagnostics).read();
    complete(protocol);
    return joined.toml.is_whole;
}

} // namespace overt
