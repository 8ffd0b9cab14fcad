/// The outputs of markers of a session, as the protocol names them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiment/ports/clock.h"
#include "experiment/ports/marker_sink.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class MarkerEquipment {
  public:
    /// Opens them. In virtual time nothing but what rides on the picture is marked. `session`: tells streams
    /// of several sessions apart. `tell`: what the operator should know. `clock` must outlive this. Throws
    /// DeviceError for an output that is required and cannot be had.
    MarkerEquipment(const Protocol& protocol, Clock& clock, bool virtual_time, const std::string& session,
                    const std::function<void(const std::string&)>& tell);

    /// One for each [[marker_output]], see SessionPorts::markers.
    std::vector<MarkerSink*> sinks() const;
    /// A line for each, for the operator and the record.
    const std::vector<std::string>& descriptions() const { return descriptions_; }

  private:
    std::vector<std::unique_ptr<MarkerSink>> sinks_;
    std::vector<std::string> descriptions_;
};

/// Lines for an overview of the machine: ports that markers could be sent to. Opens none.
std::vector<std::string> marker_overview();

} // namespace overt
