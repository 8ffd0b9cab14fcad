/// `overt doctor --report`: what was found of a rig, as a page that a lab can keep.
#pragma once

#include <functional>
#include <vector>

#include "app/display/display_commands.h"
#include "app/display/doctor_finding.h"

namespace overt {

/// Writes Markdown to `given.report`: machine and program, all findings, what is missing with what mends
/// it, and, where they are asked for, the screen's refreshes and its light, each with a figure (SVG and PDF)
/// beside the page. Gives 1 if something would refuse a session or a sensor missed a change. Throws
/// InputError for a file that is there already, before anything is measured; RecordError if it cannot be
/// written.
int write_doctor_report(const DoctorOptions& given,
                        const std::function<std::vector<DoctorFinding>()>& examine);

} // namespace overt
