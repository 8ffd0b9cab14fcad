/// A protocol while it is read and checked: what was found wrong in it, and where.
#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/diagnostics.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// A protocol under examination. Findings about a key are kept back where the key itself was found wrong
/// before: its default stands in for it, and what follows from that is none of the user's doing.
class ProtocolExamination {
  public:
    /// Both outlive the examination.
    ProtocolExamination(Protocol& examined, Diagnostics& found)
        : protocol(examined), diagnostics_(found), file_(examined.file.string()) {}

    Protocol& protocol;
    std::set<std::string, std::less<>> faulty; ///< paths of keys that were found wrong

    /// Reports at the first of these keys that is written. Does nothing if one of them is faulty.
    void error(std::initializer_list<std::string_view> paths, std::string message, std::string hint = {});
    void error(const std::vector<std::string>& paths, std::string message, std::string hint = {});
    void warning(std::initializer_list<std::string_view> paths, std::string message, std::string hint = {});

    /// "line 12", or "line 12 of rig.toml" for a key that stands in another file than the key `seen_from`.
    std::string line_of(std::string_view path, std::string_view seen_from) const;

    /// Where findings about files that the protocol names belong.
    Diagnostics& diagnostics() { return diagnostics_; }

    bool is_written(std::string_view path) const { return protocol.places.is_written(path); }

  private:
    bool is_any_faulty(std::initializer_list<std::string_view> paths) const;

    Diagnostics& diagnostics_;
    std::string file_;
};

} // namespace overt
