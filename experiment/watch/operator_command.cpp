#include "experiment/watch/operator_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/utf8_text.h"
#include "experiment/watch/session_view.h"

namespace overt {

namespace {

using CommandKey = ResponsePress::Key;

constexpr CommandKey command_keys[] = {CommandKey::pause,  CommandKey::recalibrate, CommandKey::drift_check,
                                       CommandKey::repeat, CommandKey::reject,      CommandKey::skip,
                                       CommandKey::abort};

} // namespace

std::optional<OperatorCommand> operator_command(std::string_view words) {
    while (!words.empty() && (words.back() == ' ' || words.back() == '\r'))
        words.remove_suffix(1);
    OperatorCommand command;
    if (words == "yes" || words == "no") {
        command.kind = words == "yes" ? OperatorCommand::Kind::yes : OperatorCommand::Kind::no;
        return command;
    }
    if (words.starts_with("note ")) {
        const std::string_view text = words.substr(5);
        const bool has_controls = std::any_of(text.begin(), text.end(), [](char letter) {
            return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
        });
        if (text.empty() || text.size() > longest_note || has_controls || !is_utf8(text))
            return std::nullopt;
        command.kind = OperatorCommand::Kind::note;
        command.length = text.size();
        std::copy(text.begin(), text.end(), command.text.begin());
        return command;
    }
    if (words.size() == 6 && words.starts_with("skip ") && words[5] >= '1' && words[5] <= '9') {
        command.reason = words[5] - '0';
        words = "skip";
    }
    for (const CommandKey key : command_keys)
        if (name_of(key) == words) {
            command.key = key;
            return command;
        }
    return std::nullopt;
}

std::string words_of(const OperatorCommand& command) {
    switch (command.kind) {
    case OperatorCommand::Kind::yes:
        return "yes";
    case OperatorCommand::Kind::no:
        return "no";
    case OperatorCommand::Kind::note:
        return fmt::format("note {}", command.note());
    case OperatorCommand::Kind::key:
        break;
    }
    return command.reason > 0 ? fmt::format("{} {}", name_of(command.key), command.reason)
                              : std::string(name_of(command.key));
}

std::string_view known_commands() noexcept {
    return "pause, recalibrate, drift check, repeat, reject, skip, skip N (a reason), abort, note TEXT; yes "
           "and no "
           "answer what the session asks";
}

std::string line_of_greeting() { return fmt::format("{{\"overt_watch\":{}}}\n", view_version); }

std::string line_of(const OperatorCommand& command) {
    const nlohmann::ordered_json json{{"command", words_of(command)}};
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

CommandLine read_command_line(std::string_view line) {
    CommandLine read;
    const auto json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (!json.is_object())
        return read;
    if (const auto version = json.find("overt_watch"); version != json.end() && version->is_number_integer())
        read.greeting = version->get<int>();
    else if (const auto words = json.find("command"); words != json.end() && words->is_string())
        read.command = operator_command(words->get<std::string>());
    return read;
}

} // namespace overt
