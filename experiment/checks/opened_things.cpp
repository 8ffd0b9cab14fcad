#include "experiment/checks/opened_things.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/ports/vendor_libraries.h"
#include "experiment/spectra/metal_table.h"

namespace overt {
namespace {

class OpenedList {
  public:
    void add(std::string kind, const std::string& whose, std::string what) {
        OpenedThing thing{std::move(kind), whose, std::move(what)};
        if (std::find(list.begin(), list.end(), thing) == list.end())
            list.push_back(std::move(thing));
    }

    void add_library(const std::string& whose, std::string_view name) {
        if (name.empty())
            return;
        const VendorLibrary& library = vendor_library(name);
        const char* const named = std::getenv(library.variable);
        std::vector<std::string> usual;
        for (const char* const file : library.usual_names)
            if (file)
                usual.emplace_back(file);
        add("library", whose,
            named && *named
                ? fmt::format("{}: {}, by {} of the environment or --library", library.what, named,
                              library.variable)
                : fmt::format("{}: {}, from where the system looks", library.what, fmt::join(usual, " or ")));
    }

    /// `address`: of the protocol; empty: `usual`.
    void add_address(const std::string& whose, const std::string& address, std::string_view usual) {
        if (!address.empty())
            add("device or address", whose, address);
        else if (!usual.empty())
            add("device or address", whose, fmt::format("{} (no address is given)", usual));
    }

    /// Of a file that lies in the protocol's folder, or below it, nothing.
    void add_file(const std::string& whose, const std::filesystem::path& folder,
                  const std::filesystem::path& file) {
        if (file.empty())
            return;
        const std::filesystem::path seen =
            std::filesystem::absolute(file).lexically_normal().lexically_relative(
                std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal());
        if (seen.empty() || *seen.begin() == "..")
            add("file outside", whose, file.lexically_normal().string());
    }

    std::vector<OpenedThing> list;
};

void add_tracker(OpenedList& opened, const std::string& whose, const TrackerSettings& tracker) {
    const TrackerKindRow& row = row_of(tracker.kind);
    opened.add_library(whose, row.library);
    // What is made up is not sent on.
    const bool has_outlet = tracker.outlet && row.is_hardware();
    if (has_outlet)
        opened.add_library(whose + " outlet", "lsl");
    if (row.name == "replay")
        opened.add("file", whose, tracker.address);
    else if (row.is_hardware())
        opened.add_address(whose, tracker.address, row.usual_address);
    if (has_outlet)
        opened.add("device or address", whose + " outlet",
                   "a stream that anyone in the local network can read");
}

void add_display(OpenedList& opened, const DisplaySettings& display) {
    const bool needs_box = row_of(display.output).top_rows == TopRows::t_lock;
    if (!needs_box || display.box == "none")
        return;
    opened.add("device or address", "[display] box",
               display.box == "auto" ? "the Display++ or Bits# among the serial ports /dev/ttyACM*"
                                     : display.box);
}

void add_files(OpenedList& opened, const Protocol& protocol) {
    // Of "a.toml" the parent is empty, and an empty path has no absolute one.
    const std::filesystem::path named = protocol.file.parent_path(), folder = named.empty() ? "." : named;
    for (const IncludedText& included : protocol.included)
        opened.add_file("include, trials or series", folder, included.file);
    for (const ObjectSettings& object : protocol.objects) {
        const std::string whose = fmt::format("[[object]] \"{}\"", object.id);
        opened.add_file(whose, folder, object.mesh);
        opened.add_file(whose, folder, object.labels);
        opened.add_file(whose, folder, object.lut);
    }
    for (const MaterialSettings& material : protocol.materials)
        if (is_metal_file(material.metal))
            opened.add_file(fmt::format("[[material]] \"{}\"", material.id), folder, material.metal);
    for (const LightSettings& light : protocol.lights)
        if (light.is_file())
            opened.add_file(fmt::format("[[light]] \"{}\"", light.id), folder, light.probe);
    for (const FrameSequenceSettings& frames : protocol.frames)
        opened.add_file("[[frames]]", folder, frames.files);
    opened.add_file("[display] characterisation", folder, protocol.display.characterisation_file);
}

} // namespace

std::vector<OpenedThing> opened_by(const Protocol& protocol) {
    OpenedList opened;
    add_display(opened, protocol.display);
    add_tracker(opened, "[tracker]", protocol.tracker);
    for (const FurtherTrackerSettings& further : protocol.further_trackers)
        add_tracker(opened, fmt::format("[[further_tracker]] \"{}\"", further.id), further);
    for (const ButtonBoxSettings& box : protocol.button_boxes)
        opened.add_address(fmt::format("[[button_box]] \"{}\"", box.id), box.address,
                           row_of(box.kind).usual_address);
    for (const MarkerOutputSettings& output : protocol.marker_outputs) {
        const std::string whose = fmt::format("[[marker_output]] \"{}\"", output.id);
        opened.add_library(whose, row_of(output.kind).library);
        opened.add_address(whose, output.address, row_of(output.kind).usual_address);
    }
    if (protocol.answers.record != AnswerUse::none)
        opened.add("microphone", "[answers]",
                   protocol.answers.device.empty() ? "the system's default input" : protocol.answers.device);
    if (protocol.calibration.beeps && row_of(protocol.tracker.kind).measures_gaze)
        opened.add("sound", "[calibration] beeps", "the system's default output");
    for (const Task& task : protocol.tasks)
        if (have_tones(task.steps))
            opened.add("sound", fmt::format("feedback of task \"{}\"", task.id),
                       "the system's default output");
    add_files(opened, protocol);
    return opened.list;
}

std::string to_text(const std::vector<OpenedThing>& opened) {
    std::string text = "\nWhat a session opens besides the screen and the files of the protocol's folder\n\n";
    if (opened.empty())
        text += "  nothing\n";
    for (const OpenedThing& thing : opened)
        text += fmt::format("  {:<18}{}: {}\n", thing.kind, thing.whose, thing.what);
    return text;
}

} // namespace overt
