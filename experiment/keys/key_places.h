/// Where each key stands in a TOML file, so that whoever finds a value wrong can point at it.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "experiment/base/diagnostics.h"

namespace overt {

/// Places by path: "display.refresh_hz", "object[0].mesh" (entries of a list count from 0), "object[0]"
/// for the entry's heading.
class KeyPlaces {
  public:
    void note(std::string path, Place place);

    /// Whether the file has the key, rather than leaving it to its default.
    bool is_written(std::string_view path) const;

    /// Place of the key's value; for a key left out, of the section that would hold it, or else line 1.
    Place of(std::string_view path) const;

    /// Place of the first of these keys that the file has; if it has none, as of() for the first.
    Place first_written(std::initializer_list<std::string_view> paths) const;

  private:
    std::map<std::string, Place, std::less<>> places_;
};

} // namespace overt
