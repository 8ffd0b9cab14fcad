/// What `overt doctor` says of the machine itself: what lets a session keep time, and open its devices.
#pragma once

#include <filesystem>
#include <vector>

#include "app/display/doctor_finding.h"

namespace overt {

/// Processors and their governor, real-time priority, locked memory, the rule of udev for devices, the group
/// of serial ports, free disk; each with what mends it where it is not as a session would have it. Tries
/// real-time priority on a thread of its own; changes nothing.
std::vector<DoctorFinding> examine_machine();

/// Whether the rule that comes with overt lies in one of udev's folders, and the command that puts it there.
DoctorFinding udev_finding(const std::vector<std::filesystem::path>& folders);

/// What the processors' governors are: other than "performance" they slow down where nothing is to be done,
/// and take milliseconds to come back. `cpus`: the folder cpu of sysfs; nothing is said where it tells of
/// none.
std::vector<DoctorFinding> governor_findings(const std::filesystem::path& cpus);

} // namespace overt
