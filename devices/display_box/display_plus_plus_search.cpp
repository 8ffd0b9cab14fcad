#include "devices/display_box/display_plus_plus_search.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "devices/display_box/switch_record.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// Instruments of the same vendor that speak otherwise: ColorCAL MkII, SpectroCAL, LiveTrack.
constexpr std::array<std::uint16_t, 3> other_crs_products{0x1001, 0x1003, 0x3437};

bool is_from_crs(const SerialPortInfo& port) { return port.vendor_id == crs_vendor_id; }

bool may_be_a_box(const SerialPortInfo& port) {
    return !is_from_crs(port) || !port.product_id ||
           std::ranges::find(other_crs_products, *port.product_id) == other_crs_products.end();
}

using Boxes = std::vector<std::unique_ptr<DisplayPlusPlus>>;

/// Those that answer; of the others the reason goes into `refusals`.
Boxes ask_all(std::span<const SerialPortInfo> ports, const TransportOpener& open, Clock& clock,
              const DisplayPlusPlusSettings& settings, std::string& refusals) {
    Boxes boxes;
    for (const SerialPortInfo& port : ports) {
        try {
            boxes.push_back(std::make_unique<DisplayPlusPlus>(open(port.path), clock, settings));
        } catch (const DeviceError& error) {
            refusals += fmt::format("\n  {}", error.what());
        }
    }
    return boxes;
}

AskedPort ask_at(const SerialPortInfo& port, const TransportOpener& open, Clock& clock,
                 const DisplayPlusPlusSettings& settings) {
    AskedPort asked{port, {}, 0.0, {}};
    try {
        DisplayPlusPlus box(open(port.path), clock, settings);
        asked.box = box.identity();
        asked.video_rate_hz = box.video_rate_hz();
    } catch (const DeviceError& error) {
        asked.otherwise = error.what();
    }
    return asked;
}

std::unique_ptr<DisplayPlusPlus> the_only_one(Boxes boxes) {
    if (boxes.size() == 1)
        return std::move(boxes.front());
    std::string found;
    for (const auto& box : boxes)
        found += fmt::format("\n  {}: {}, serial number {}", box->identity().port, box->identity().product,
                             box->identity().serial_number);
    throw DeviceError(
        fmt::format("{} display boxes answer; name the port of the one to use:{}", boxes.size(), found));
}

} // namespace

std::unique_ptr<DisplayPlusPlus> find_display_plus_plus(std::span<const SerialPortInfo> candidates,
                                                        const std::optional<std::string>& port,
                                                        const TransportOpener& open, Clock& clock,
                                                        const DisplayPlusPlusSettings& settings) {
    if (port)
        return std::make_unique<DisplayPlusPlus>(open(*port), clock, settings);
    std::vector<SerialPortInfo> ports;
    std::string refusals;
    for (const SerialPortInfo& candidate : candidates) {
        if (may_be_a_box(candidate))
            ports.push_back(candidate);
        else
            refusals += fmt::format("\n  {}: another kind of instrument, not asked", describe(candidate));
    }
    // A device of another maker is asked only if none of the vendor's answers: it may take the question for
    // something else.
    const auto others = std::stable_partition(ports.begin(), ports.end(), is_from_crs);
    for (const auto& group : {std::span(ports.begin(), others), std::span(others, ports.end())})
        if (Boxes boxes = ask_all(group, open, clock, settings, refusals); !boxes.empty())
            return the_only_one(std::move(boxes));
    if (candidates.empty())
        throw DeviceError("no display box was found: there is no USB serial port (/dev/ttyACM*); plug in the "
                          "box's USB cable, see that "
                          "its USB mode is CDC and not mass storage, or say that the display has no box.");
    throw DeviceError(fmt::format(
        "no display box was found; see that its USB cable is in and its USB mode is CDC, or say that "
        "the display has no box. Asked were:{}",
        refusals));
}

std::vector<AskedPort> ask_for_display_boxes(std::span<const SerialPortInfo> candidates,
                                             const std::optional<std::string>& port,
                                             const TransportOpener& open, Clock& clock,
                                             const DisplayPlusPlusSettings& settings) {
    if (port)
        return {ask_at({.path = *port}, open, clock, settings)};
    std::vector<AskedPort> all;
    const auto ask_those = [&](auto&& belongs) {
        for (const SerialPortInfo& candidate : candidates)
            if (may_be_a_box(candidate) && belongs(candidate))
                all.push_back(ask_at(candidate, open, clock, settings));
    };
    ask_those(is_from_crs);
    const bool found = std::ranges::any_of(all, [](const AskedPort& asked) { return asked.box.has_value(); });
    if (!found)
        ask_those([](const SerialPortInfo& candidate) { return !is_from_crs(candidate); });
    for (const SerialPortInfo& candidate : candidates) {
        if (!may_be_a_box(candidate))
            all.push_back({candidate, {}, 0.0, "another kind of instrument, not asked"});
        else if (found && !is_from_crs(candidate))
            all.push_back({candidate, {}, 0.0, "another maker's device, not asked: the box was found"});
    }
    return all;
}

std::optional<std::string> recover_display(std::span<const SerialPortInfo> candidates,
                                           const TransportOpener& open, Clock& clock,
                                           const DisplayPlusPlusSettings& settings) {
    const auto record = read_switch_record(settings.record_folder);
    if (!record || record->kept)
        return std::nullopt;
    std::vector<SerialPortInfo> ports;
    for (const SerialPortInfo& candidate : candidates)
        if (may_be_a_box(candidate) && candidate.path != record->port)
            ports.push_back(candidate);
    ports.insert(ports.begin(), SerialPortInfo{.path = record->port});
    std::string refusals;
    for (const SerialPortInfo& port : ports) {
        const Boxes answering = ask_all({&port, 1}, open, clock, settings, refusals);
        if (answering.empty())
            continue;
        DisplayPlusPlus& box = *answering.front();
        if (box.identity().serial_number == record->serial_number) {
            box.restore_desktop();
            return fmt::format(
                "{} on {} was left in {} mode by a run that did not end well; it is back in Bits++.",
                box.identity().product, port.path, record->mode);
        }
        refusals +=
            fmt::format("\n  {}: another box, serial number {}", port.path, box.identity().serial_number);
    }
    throw DeviceError(fmt::format("the display box {} was left in {} mode by a run that did not end well, or "
                                  "is still at it; it could not be switched back: plug it in, or wait until "
                                  "that run has ended. Asked were:{}",
                                  record->serial_number, record->mode, refusals));
}

} // namespace overt
