#include "app/record/recorded_protocol.h"

#include "app/inputs/protocol_file.h"
#include "experiment/checks/checked_protocol.h"

namespace overt {

std::optional<Protocol> recorded_protocol(const SessionHeader& header, Diagnostics& diagnostics) {
    IncludedTexts included;
    for (const RecordedProtocol::Included& file : header.protocol.included)
        included[file.name] = file.text;
    return read_protocol_text(header.protocol.text, "protocol.toml", shipped_sculpture_names(), diagnostics,
                              included);
}

} // namespace overt
