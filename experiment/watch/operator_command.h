/// What an operator tells a session from the operator's view: the operator's keys, answers to what the
/// session asks, and notes. One JSON object a line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/ports/response_panel.h"

namespace overt {

inline constexpr std::size_t longest_command_line = 1024; ///< bytes
inline constexpr std::size_t longest_note = 400;          ///< bytes of UTF-8

/// A plain value, that goes through rings.
struct OperatorCommand {
    enum class Kind : std::uint8_t {
        key,  ///< one of the operator's; what the session asks about it is answered with yes
        yes,  ///< to a question that the session asks by itself
        no,   ///< likewise
        note, ///< a remark for the record
    };
    Kind kind = Kind::key;
    ResponsePress::Key key = ResponsePress::Key::pause; ///< of a key
    int reason = 0;                                     ///< of skipping: from 1; 0: none is given
    std::array<char, longest_note> text{};
    std::size_t length = 0; ///< of a note, bytes

    std::string_view note() const noexcept { return {text.data(), length}; }
};

/// What an operator types: "pause", "recalibrate", "drift check", "repeat", "reject", "skip", "skip 2",
/// "abort", "yes", "no", "note TEXT". Nothing for anything else, and for a note without words, too long, or
/// not UTF-8.
std::optional<OperatorCommand> operator_command(std::string_view words);

/// The same in words, as operator_command() reads it.
std::string words_of(const OperatorCommand& command);

/// Those that an operator can give, a line each, for help.
std::string_view known_commands() noexcept;

/// The first line of a view, which says its language; and that of a command.
std::string line_of_greeting();
std::string line_of(const OperatorCommand& command);

/// What the line of a view says.
struct CommandLine {
    std::optional<int> greeting; ///< the version of its language
    std::optional<OperatorCommand> command;
};
CommandLine read_command_line(std::string_view line);

} // namespace overt
