/// What `overt doctor` says of eye trackers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/display/doctor_finding.h"
#include "devices/link/network_cards.h"

namespace overt {

/// Each kind that is a device: what it can do, and what of it is found here. Nothing is changed at a tracker,
/// and none is made to record.
std::vector<DoctorFinding> examine_trackers();

/// Whether an EyeLink's host could be reached: it is at 100.1.1.1 as it is delivered, and wants the other
/// computer in its net, 100.1.1.x with mask 255.255.255.0.
std::string eyelink_network(std::span<const NetworkCard> cards);

} // namespace overt
