/// Reading a protocol on behalf of a command.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "experiment/base/diagnostics.h"
#include "experiment/base/error.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// A file was refused and its findings are printed already: main only has to leave with code 2.
class FindingsPrinted : public InputError {
  public:
    using InputError::InputError;
};

/// Names of the objects that overt makes itself.
std::vector<std::string_view> shipped_sculpture_names();

/// Reads a protocol, with the objects that overt makes itself as those it may name. See read_protocol().
std::optional<Protocol> read_protocol_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// The same, with all findings printed to standard error; throws FindingsPrinted if one of them is an error.
Protocol read_protocol_or_report(const std::filesystem::path& file);

/// To standard error.
void print_findings(const Diagnostics& diagnostics);

/// The observer of a label: its number is the one at the label's end. Throws InputError if it has none, or if
/// no file can be named by the label.
Observer observer_labelled(const std::string& label);

/// The stimulus called OBJECT/MATERIAL, with the ids of what else there is a choice of behind it: see
/// stimulus_name(). Ids that are left out at the end are the first of their lists. Throws InputError naming
/// those there are.
Stimulus stimulus_called(const Protocol& protocol, const std::string& name);

/// A stimulus with the object called OBJECT, with that called OBJECT/VIEW where there are several views, or
/// the stimulus of that name; what the name leaves open is the first of its list. Throws InputError naming
/// those there are.
Stimulus object_called(const Protocol& protocol, const std::string& name);

} // namespace overt
