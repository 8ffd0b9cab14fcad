/// What a Display++ is known to answer, without a line: bytes in, bytes out.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "devices/display_box/bits_protocol.h"

namespace overt::test {

class BitsBoxModel {
  public:
    std::string product = "Display++", serial_number = "DPP-0042", firmware_date = "Mar 14 2018";
    double rate_hz = 120.0;
    double mode_change_s =
        0.0; ///< silent for so long after a change of mode, then unsteady for as long again
    std::string line_end = "\n\r";   ///< of the replies to ProductType and FirmwareDate
    std::string before_reply;        ///< said before each reply
    std::set<std::string> silent_on; ///< commands that it does not answer
    /// What arrives at a pixel of a line.
    std::function<RgbBytes(int line, int pixel)> video = [](int, int) { return RgbBytes{0, 0, 0}; };

    std::string mode = "BitsPlusPlus", dithering = "ON", gamma_table;
    bool streaming = false;
    std::vector<std::string> commands; ///< all that it understood, in order

    /// Takes bytes at a time of its own clock and gives those it answers with.
    std::string receive(std::string_view bytes, double now_s) {
        std::string answer;
        for (const char byte : bytes) {
            if (byte != '\r') {
                command_ += byte;
                continue;
            }
            answer += obey(command_, now_s);
            command_.clear();
        }
        return answer;
    }

    std::uint64_t next_sample = 1;
    bool trigger = false;
    std::string inputs = "1111111111111111"; ///< 10 digital, 6 infrared
    double first_analogue_v = 0.0;

    std::string status_line(double box_s) {
        std::string line = fmt::format("#sample;{};{:.6f};{};", next_sample++, box_s, trigger ? 1 : 0);
        for (const char level : inputs)
            line += {level, ';'};
        line += fmt::format("{:.6f};0.000000;0.000000;-0.012500;0.000000;0.000000;\r", first_analogue_v);
        return line;
    }

  private:
    std::string obey(const std::string& command, double now_s) {
        const std::size_t dollar = command.rfind('$');
        if (dollar == std::string::npos)
            return {};
        const std::size_t equals = command.find('=', dollar);
        const std::string name =
            command.substr(dollar + 1, equals == std::string::npos ? equals : equals - dollar - 1);
        const std::string argument =
            equals == std::string::npos ? "" : command.substr(equals + 2, command.size() - equals - 3);
        // Half a command in front makes the whole of it unknown.
        if (dollar != 0 && command.front() == '$')
            return {};
        commands.push_back(name);
        if (silent_on.contains(name) || now_s < changing_until_s_ - mode_change_s)
            return {};
        const std::string reply = answer_to(name, argument, now_s);
        return reply.empty() ? reply : before_reply + reply;
    }

    std::string answer_to(const std::string& name, const std::string& argument, double now_s) {
        if (name == "ProductType")
            return "#ProductType;" + product + ";" + line_end;
        if (name == "SerialNumber")
            return "#SerialNumber;" + serial_number + std::string("\0\n\r", 3);
        if (name == "FirmwareDate")
            return "#FirmwareDate;" + firmware_date + ";" + line_end;
        if (name == "VideoFrameRate")
            return fmt::format("#VideoFrameRate;{:.3f};Hz;\r",
                               now_s < changing_until_s_ ? 20.0 + 3.0 * static_cast<double>(++wrong_rates_)
                                                         : rate_hz);
        if (name == "GetVideoLine")
            return video_line(argument);
        if (name == "Start" || name == "Stop")
            streaming = name == "Start";
        if (name == "TemporalDithering")
            dithering = argument;
        if (name == "enableGammaCorrection")
            gamma_table = argument;
        if (name.ends_with("PlusPlus")) {
            mode = name == "colourPlusPlus" ? "colorPlusPlus" : name;
            changing_until_s_ = now_s + 2.0 * mode_change_s;
        }
        return {};
    }

    std::string video_line(const std::string& argument) {
        mode = "statusScreen";
        const std::size_t comma = argument.find(',');
        const int line = std::stoi(argument), pixels = std::stoi(argument.substr(comma + 1));
        std::string reply = "#GetVideoLine;";
        for (int pixel = 0; pixel < pixels; ++pixel)
            for (const std::uint8_t byte : video(line, pixel))
                reply += fmt::format("{:02};", byte); // padded to two digits, as Psychtoolbox expects
        return reply + "\r";
    }

    std::string command_;
    double changing_until_s_ = 0.0;
    int wrong_rates_ = 0;
};

} // namespace overt::test
