/// Finding the display box among the serial ports, and switching it back after a crash.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/display_box/display_plus_plus.h"
#include "devices/link/serial_port_search.h"

namespace overt {

/// Asks "$ProductType" on each candidate that is no instrument known to be another, those of the vendor
/// first, and takes the one that answers. With `port` only that one is asked, whatever it is. Throws
/// DeviceError that says of every port what came of it: if none answers, if more than one does, if there is
/// no port at all.
std::unique_ptr<DisplayPlusPlus> find_display_plus_plus(std::span<const SerialPortInfo> candidates,
                                                        const std::optional<std::string>& port,
                                                        const TransportOpener& open, Clock& clock,
                                                        const DisplayPlusPlusSettings& settings = {});

/// What came of asking at one port.
struct AskedPort {
    SerialPortInfo port;
    std::optional<BoxIdentity> box;
    double video_rate_hz = 0.0; ///< of a box: 0 if it sees no video
    std::string otherwise;      ///< why there is no box, in a sentence
};

/// Asks as find_display_plus_plus() does, and says of each port what came of it. Throws nothing.
std::vector<AskedPort> ask_for_display_boxes(std::span<const SerialPortInfo> candidates,
                                             const std::optional<std::string>& port,
                                             const TransportOpener& open, Clock& clock,
                                             const DisplayPlusPlusSettings& settings = {});

/// Switches a box back to Bits++ that an earlier run left switched, as the note in settings.record_folder
/// says: at the noted port, else at any candidate with the noted serial number. Gives a sentence on what was
/// done, nothing if no note was there or the mode was kept on purpose. Throws DeviceError if the box is not
/// found or its port is in use; the note then stays.
std::optional<std::string> recover_display(std::span<const SerialPortInfo> candidates,
                                           const TransportOpener& open, Clock& clock,
                                           const DisplayPlusPlusSettings& settings);

} // namespace overt
