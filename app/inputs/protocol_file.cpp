#include "app/inputs/protocol_file.h"

#include <cstdio>

#include <fmt/format.h>

#include "experiment/checks/checked_protocol.h"
#include "experiment/design/schedule.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/record/session_directory.h"
#include "experiment/scene/sculptures/novel_shapes.h"
#include "experiment/scene/sculptures/sculptures.h"

namespace overt {

std::vector<std::string_view> shipped_sculpture_names() {
    std::vector<std::string_view> names;
    for (const SculptureDescription& object : shipped_sculptures())
        names.push_back(object.name);
    for (const std::string& shape : novel_shape_names())
        names.push_back(shape);
    return names;
}

std::optional<Protocol> read_protocol_file(const std::filesystem::path& file, Diagnostics& diagnostics) {
    return read_protocol(file, shipped_sculpture_names(), diagnostics);
}

Protocol read_protocol_or_report(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    std::optional<Protocol> protocol = read_protocol_file(file, diagnostics);
    print_findings(diagnostics);
    if (!protocol)
        throw FindingsPrinted(fmt::format("{}: cannot be used", file.string()));
    return *std::move(protocol);
}

void print_findings(const Diagnostics& diagnostics) {
    const std::string findings = diagnostics.print();
    std::fwrite(findings.data(), 1, findings.size(), stderr);
}

Observer observer_labelled(const std::string& label) {
    check_observer_label(label);
    const std::optional<int> number = observer_number(label);
    if (!number) {
        const char last = label.back();
        if (last >= '0' && last <= '9')
            throw InputError(
                fmt::format("observer \"{}\": the number at its end decides which materials are shown, "
                            "and is from 1 to 999999999",
                            label));
        throw InputError(fmt::format(
            "observer \"{}\" has no number at its end, and the number decides which materials are "
            "shown: call the observer {}01, say",
            label, label));
    }
    return {label, *number};
}

Stimulus stimulus_called(const Protocol& protocol, const std::string& name) {
    std::vector<std::string> names;
    for (const Stimulus& stimulus : stimuli_in_slots(protocol)) {
        names.push_back(stimulus_name(protocol, stimulus));
        // The first of those that begin so has the first entries of what is left out.
        const bool has_material = name.find('/') != std::string::npos;
        if (names.back() == name || (has_material && names.back().starts_with(name + '/')))
            return stimulus;
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw InputError(fmt::format("no stimulus is called \"{}\": {}", name, suggest_name(name, known)));
}

Stimulus object_called(const Protocol& protocol, const std::string& name) {
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < protocol.objects.size(); ++i) {
        known.push_back(protocol.objects[i].id);
        if (known.back() == name)
            return {static_cast<int>(i)};
    }
    if (name.find('/') == std::string::npos)
        throw InputError(fmt::format("no object is called \"{}\": {}", name, suggest_name(name, known)));
    for (const ViewedObject& viewed : all_viewed_objects(protocol))
        if (viewed_name(protocol, viewed) == name)
            return {.object = viewed.object, .view = viewed.view};
    return stimulus_called(protocol, name);
}

} // namespace overt
