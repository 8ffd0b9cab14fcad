#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/ports/button_meaning.h"
#include "experiment/protocol/marker_codes.h"

namespace overt {
namespace {

constexpr double longest_t_lock_ms = 24.8; // 248 slots of 0.1 ms

template <class Entry>
void check_device_ids(ProtocolExamination& examination, std::string_view list,
                      const std::vector<Entry>& entries) {
    std::set<std::string_view> ids;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (!entries[i].id.empty() && !ids.insert(entries[i].id).second)
            examination.error({fmt::format("{}[{}].id", list, i)},
                              fmt::format("id \"{}\" is taken already", entries[i].id));
}

bool says(const std::vector<ButtonMeaning>& meanings, ResponsePress::Key key) {
    return std::ranges::find(meanings, key, &ButtonMeaning::key) != meanings.end();
}

/// Keys of [[button_box]] that are of knobs.
constexpr std::string_view keys_of_knobs[] = {"steps_per_count", "full_turn_steps_s", "full_tilt_steps_s",
                                              "dead_zone"};

/// Gives what the buttons mean, as far as that can be read.
std::vector<ButtonMeaning> check_button_box(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const ButtonBoxSettings& box = protocol.button_boxes[index];
    const auto path = [&](std::string_view key) { return fmt::format("button_box[{}].{}", index, key); };
    std::vector<ButtonMeaning> meanings;
    std::set<std::string> named;
    for (const std::string& text : box.buttons) {
        try {
            meanings.push_back(parse_button_meaning(text, box.is_operators()));
        } catch (const InputError& fault) {
            examination.error({path("buttons")}, fault.what());
            continue;
        }
        if (!named.insert(meanings.back().button).second)
            examination.error({path("buttons")},
                              fmt::format("the button {} has two meanings", meanings.back().button));
    }
    if (box.is_operators() && box.buttons.empty())
        examination.error({path("used_by")}, "an operator's box needs \"buttons\": none would do anything",
                          "such as buttons = [\"1 pause\", \"2 yes\", \"3 no\"]");
    const ButtonBoxKindRow& kind = row_of(box.kind);
    if (!kind.needs_address.empty() && box.address.empty())
        examination.error({path("kind")}, fmt::format("a box of kind {} needs its \"address\"", kind.name),
                          std::string(kind.needs_address));
    for (const std::string_view key : keys_of_knobs)
        if (examination.is_written(path(key)) && !kind.has_key(key))
            examination.error({path(key), path("kind")},
                              fmt::format("\"{}\" says nothing of a box of kind {}", key, kind.name),
                              "leave it out");
    if (box.is_operators() && !kind.keys.front().empty())
        examination.error({path("used_by")}, "a knob is the observer's: it answers, and decides nothing",
                          "leave it out");
    if (kind.is_read_by_display_box) {
        if (!box.address.empty())
            examination.error({path("address")},
                              "a CB6 is read through the box of [display]: it has no address");
        if (!has_t_lock(protocol.display.output) || protocol.display.box == "none")
            examination.error({path("kind"), "display.output", "display.box"},
                              "a CB6 is read through a Display++ or Bits#, and this session has none",
                              "take output = \"mono++\", \"color++\" or \"bits++\" and a box in [display]");
    }
    return meanings;
}

void check_who_answers(ProtocolExamination& examination, const std::vector<ButtonMeaning>& observers,
                       bool any_button_goes_on) {
    const Protocol& protocol = examination.protocol;
    if (protocol.operators.keyboard_answers)
        return;
    if (!any_button_goes_on && !says(observers, ResponsePress::Key::next))
        examination.error({"operator.keyboard_answers"},
                          "nothing would answer for the observer: no [[button_box]] of theirs goes on",
                          "add a [[button_box]] with used_by = \"observer\"");
    if (!protocol.consent.text.empty() &&
        !(says(observers, ResponsePress::Key::yes) && says(observers, ResponsePress::Key::no)))
        examination.error({"operator.keyboard_answers"},
                          "the observer could not agree or decline: no button says yes and no",
                          "map both in \"buttons\" of the observer's [[button_box]]");
}

void check_codes(ProtocolExamination& examination, std::size_t index) {
    const MarkerOutputSettings& output = examination.protocol.marker_outputs[index];
    const auto check = [&](std::string_view key, auto keep) {
        MarkerOutputSettings alone = output;
        keep(alone);
        try {
            MarkerCodes(examination.protocol, alone);
        } catch (const InputError& fault) {
            examination.error({fmt::format("marker_output[{}].{}", index, key)}, fault.what());
            return false;
        }
        return true;
    };
    if (check("codes", [](MarkerOutputSettings& one) { one.condition_codes = one.refresh_codes = {}; }))
        check("condition_codes", [](MarkerOutputSettings& one) { one.refresh_codes = {}; });
    check("refresh_codes", [](MarkerOutputSettings& one) { one.codes = one.condition_codes = {}; });
}

void check_t_lock(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const MarkerOutputSettings& output = protocol.marker_outputs[index];
    const auto path = [&](std::string_view key) { return fmt::format("marker_output[{}].{}", index, key); };
    if (!has_t_lock(protocol.display.output))
        examination.error({path("kind"), "display.output"},
                          fmt::format("{} carries no digital outputs", name_of(protocol.display.output)),
                          "take output = \"mono++\", \"color++\" or \"bits++\"");
    if (protocol.display.onset_trigger != 0)
        examination.error({"display.onset_trigger", path("kind")},
                          "the digital outputs are those of a [[marker_output]] already",
                          "write its code there: codes = [\"onset …\"]");
    if (output.pulse_ms <= 0.0 || output.pulse_ms > longest_t_lock_ms)
        examination.error({path("pulse_ms")}, "a pulse of t-lock lasts more than 0 and at most 24.8 ms");
    for (const std::string& code : output.codes)
        if (!code.starts_with("onset ") && !code.starts_with("frame "))
            examination.error(
                {path("codes")},
                fmt::format("\"{}\": t-lock rides on the refreshes of the animation and marks onset "
                            "and frame alone",
                            code));
    for (std::size_t other = 0; other < index; ++other)
        if (row_of(protocol.marker_outputs[other].kind).rides_on_picture)
            examination.error({path("kind")}, "there is one output of kind t-lock already");
}

/// "serial, parallel and xid"
std::string outputs_with(bool MarkerOutputKindRow::*column) {
    std::vector<std::string_view> names;
    for (const MarkerOutputKindRow& kind : kinds_of<MarkerOutputKind>)
        if (kind.*column)
            names.push_back(kind.name);
    if (names.size() < 2)
        return names.empty() ? std::string() : std::string(names.front());
    return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

void check_marker_output(ProtocolExamination& examination, std::size_t index) {
    const MarkerOutputSettings& output = examination.protocol.marker_outputs[index];
    const auto path = [&](std::string_view key) { return fmt::format("marker_output[{}].{}", index, key); };
    check_codes(examination, index);
    using Row = MarkerOutputKindRow;
    const Row& kind = row_of(output.kind);
    if (kind.rides_on_picture)
        check_t_lock(examination, index);
    else if (!output.refresh_codes.empty())
        examination.error({path("refresh_codes")}, "only outputs of kind t-lock are bound to refreshes");
    if (!kind.rides_on_picture && output.offset_ms)
        examination.error({path("offset_ms")}, "only outputs of kind t-lock ride on the picture",
                          "leave it out: others are told when they are sent, and the record says when");
    if (!kind.tells_texts && !output.as_text && output.codes.empty() && output.refresh_codes.empty())
        examination.error({path("kind")}, "nothing would be marked: \"codes\" are missing",
                          "such as codes = [\"onset 10\", \"response 2\"]");
    if (kind.tells_texts && !(output.codes.empty() && output.condition_codes.empty()))
        examination.warning({path("codes"), path("condition_codes")},
                            fmt::format("codes have no effect: {} tells texts, and all of them", kind.name));
    if (!kind.needs_address.empty() && output.address.empty())
        examination.error({path("kind")},
                          fmt::format("an output of kind {} needs its \"address\"", kind.name),
                          fmt::format("such as address = \"{}\"", kind.needs_address));
    if (!kind.has_address && !output.address.empty())
        examination.error({path("address")},
                          fmt::format("only {} outputs have an address", outputs_with(&Row::has_address)));
    if (!kind.has_speed && examination.is_written(path("baud")))
        examination.error({path("baud")},
                          fmt::format("only {} outputs have a speed", outputs_with(&Row::has_speed)));
    if (!kind.has_speed && output.as_text)
        examination.error({path("as_text")},
                          fmt::format("only {} outputs take lines of text", outputs_with(&Row::has_speed)));
}

/// Two of the same device would wait for each other. What is simulated or played back is a device of its own.
bool is_same_device(const TrackerSettings& one, const TrackerSettings& other) {
    return one.kind == other.kind && one.address == other.address && !row_of(one.kind).is_made_up;
}

void check_further_tracker(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const FurtherTrackerSettings& further = protocol.further_trackers[index];
    const auto path = [&](std::string_view key) { return fmt::format("further_tracker[{}].{}", index, key); };
    if (!row_of(further.kind).measures_gaze)
        examination.error({path("kind")}, "a further tracker must measure gaze",
                          "leave the [[further_tracker]] out");
    if (!row_of(protocol.tracker.kind).measures_gaze)
        examination.error({"tracker.kind", path("kind")},
                          "there is no eye tracker of the session's own, which trials are judged by",
                          "write the further tracker's keys under [tracker] instead");
    const auto refuse = [&](const std::string& other) {
        examination.error({path("kind"), path("address")},
                          fmt::format("this is the same device as that of {}", other),
                          "give each its own \"address\"");
    };
    if (is_same_device(further, protocol.tracker))
        refuse("[tracker]");
    for (std::size_t other = 0; other < index; ++other)
        if (is_same_device(further, protocol.further_trackers[other]))
            refuse(fmt::format("the further tracker \"{}\"", protocol.further_trackers[other].id));
}

} // namespace

namespace {

/// Only what is measured in real time is sent on.
void check_outlet(ProtocolExamination& examination, const TrackerSettings& tracker, const std::string& key) {
    if (!tracker.outlet || row_of(tracker.kind).is_hardware())
        return;
    examination.warning(
        {key},
        fmt::format("\"outlet\" has no effect: {}",
                    row_of(tracker.kind).measures_gaze
                        ? fmt::format("samples of the eye tracker \"{}\" are made up, and are not "
                                      "sent on",
                                      row_of(tracker.kind).name)
                        : "there is no eye tracker"),
        "leave it out, or try the stream with kind = \"mouse\"");
}

} // namespace

void check_devices(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    check_outlet(examination, protocol.tracker, "tracker.outlet");
    for (std::size_t i = 0; i < protocol.further_trackers.size(); ++i)
        check_outlet(examination, protocol.further_trackers[i], fmt::format("further_tracker[{}].outlet", i));
    check_device_ids(examination, "further_tracker", protocol.further_trackers);
    for (std::size_t i = 0; i < protocol.further_trackers.size(); ++i)
        check_further_tracker(examination, i);
    check_device_ids(examination, "button_box", protocol.button_boxes);
    check_device_ids(examination, "marker_output", protocol.marker_outputs);
    std::vector<ButtonMeaning> observers;
    bool any_button_goes_on = false;
    for (std::size_t i = 0; i < protocol.button_boxes.size(); ++i) {
        const std::vector<ButtonMeaning> meanings = check_button_box(examination, i);
        if (protocol.button_boxes[i].is_operators())
            continue;
        observers.insert(observers.end(), meanings.begin(), meanings.end());
        any_button_goes_on = any_button_goes_on || protocol.button_boxes[i].buttons.empty();
    }
    check_who_answers(examination, observers, any_button_goes_on);
    for (std::size_t i = 0; i < protocol.marker_outputs.size(); ++i)
        check_marker_output(examination, i);
}

} // namespace overt
