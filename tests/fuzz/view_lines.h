/// What is done with any bytes as what goes through the operator's socket: shared by the fuzzer and by the
/// test that replays its corpus.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "experiment/watch/operator_command.h"
#include "experiment/watch/session_view.h"

namespace overt::fuzz {

/// Line by line, as either side reads them; what is understood is written and read again.
inline void take_view(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::string_view line = bytes.substr(0, bytes.find('\n'));
        bytes.remove_prefix(std::min(bytes.size(), line.size() + 1));
        const ViewLine read = read_view_line(line);
        if (read.facts)
            read_view_line(line_of(*read.facts));
        if (read.view)
            read_view_line(line_of(*read.view));
        if (read.event)
            read_view_line(line_of(*read.event));
        if (read.camera)
            read_view_line(line_of(*read.camera));
        read_view_line(line_of(std::span(read.gaze)));
        const CommandLine command = read_command_line(line);
        if (command.command)
            read_command_line(line_of(*command.command));
    }
}

} // namespace overt::fuzz
