/// Findings about what a user wrote: collected, so that all of them are shown at once, each with its place.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace overt {

/// A place in a text file. Lines and columns count from 1, columns in characters (Unicode code points), a tab
/// being one. Line 0: the file as a whole.
struct Place {
    int line = 0;
    int column = 0;
    int file = 0; ///< 0: the file that is spoken of; else another, as Diagnostics::number_of_file has it
    friend constexpr auto operator<=>(const Place&, const Place&) = default;
};

enum class Severity { error, warning, note };

/// One thing that is wrong (error), probably not meant (warning), or good to know (note).
struct Finding {
    Severity severity = Severity::error;
    std::string file;
    Place place;
    std::string message; ///< what is wrong, beginning in lower case, without a full stop
    std::string hint;    ///< what to do about it, or empty
};

/// Collects findings about one or several files. Not for use from several threads at once.
class Diagnostics {
  public:
    /// Keeps a file's text, so that print() can quote the lines of its findings.
    void quote_from(const std::string& file, std::string_view text);

    /// A number by which places can name a file, from 1: a finding at such a place is that file's, whatever
    /// file it is reported for.
    int number_of_file(const std::string& file);

    void error(std::string file, Place place, std::string message, std::string hint = {});
    void warning(std::string file, Place place, std::string message, std::string hint = {});
    void note(std::string file, Place place, std::string message, std::string hint = {});

    /// Adds the findings of another, with the texts that it quotes from.
    void take(const Diagnostics& other);

    /// All findings, sorted by file and place; at the same place in the order in which they were found.
    std::vector<Finding> findings() const;

    int error_count() const;
    int warning_count() const;
    bool has_errors() const { return error_count() > 0; }

    /// As a compiler prints them: `file:line:column: error: message`, the line quoted with a caret under the
    /// column, the hint; at last how many errors and warnings there are. Ends with a newline; empty if
    /// nothing was found.
    std::string print() const;

    /// For `--json`: {"errors", "warnings", "findings": [{"severity", "file", "line", "column", "message",
    /// "hint"}, …]}. Always valid UTF-8, whatever the files hold.
    nlohmann::ordered_json to_json() const;

  private:
    int count_of(Severity severity) const;
    void add(Severity severity, std::string file, Place place, std::string message, std::string hint);
    std::string quoted_line(const Finding& finding) const;

    std::vector<Finding> findings_;
    std::vector<std::string> files_;                           ///< by number, from 1
    std::map<std::string, std::vector<std::string>> lines_of_; ///< by file
};

/// The known name that was probably meant by a word: differing in few letters (one per three of them, swapped
/// neighbours counting once, case not at all), or only in the unit at its end. Nothing if none is near.
std::optional<std::string_view> nearest_name(std::string_view word, std::span<const std::string_view> known);

/// A hint for an unknown word: "did you mean "…"?", or else the list of what is known.
std::string suggest_name(std::string_view word, std::span<const std::string_view> known);

} // namespace overt
