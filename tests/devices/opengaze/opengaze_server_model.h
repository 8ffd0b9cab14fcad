/// What an Open Gaze server says, without a line: bytes in, bytes out, by a clock of its own. After the
/// document "Open Gaze API by Gazepoint", revision of March 11, 2025.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include "devices/opengaze/opengaze_message.h"

namespace overt::test {

class OpenGazeServerModel {
  public:
    double rate_hz = 150.0;
    std::string told_rate = "150";
    double time_offset_s = 1000.0;               ///< TIME when now_s is 0
    std::string tick_frequency = "10000000";     ///< as told; the counter's own is 10 MHz
    std::set<std::string> silent_on, refused_on; ///< ids
    int silent_times = 1000;                     ///< how often each of silent_on is
    bool tells_user_data = true;                 ///< its records say what they bear
    bool has_camera = true;                      ///< else no record is sent
    bool calibration_hangs = false;              ///< says nothing of it any more
    std::string told_points;                     ///< instead of how many there are
    std::function<glm::dvec2(double time_s)> gaze = [](double) { return glm::dvec2(0.25, 0.75); };
    std::function<bool(double time_s)> left_is_valid = [](double) { return true; };
    std::function<std::string(std::string record, int counter)> mutate; ///< what becomes of a record
    /// Where each target of a calibration is measured by either eye, off by so much of the screen.
    glm::dvec2 left_error{0.01, 0.0}, right_error{0.0, -0.02};
    std::set<int> invalid_points;

    // What it was told. Under the lock where a thread serves.
    std::map<std::string, std::string> values; ///< of SET, by id: all that followed the id
    std::vector<std::string> user_data;        ///< all that it was told
    std::vector<std::string> borne;            ///< what stands in its records, and so in what it keeps
    std::vector<glm::dvec2> points{{0.5, 0.5}, {0.85, 0.15}, {0.85, 0.85}, {0.15, 0.85}, {0.15, 0.15}};

    std::string receive(std::string_view bytes, double now_s) {
        const std::scoped_lock lock(mutex_);
        std::string answer;
        for (const char byte : bytes) {
            if (byte != '\n') {
                command_ += byte;
                continue;
            }
            answer += obey(command_, now_s);
            command_.clear();
        }
        return answer;
    }

    /// All that is due by now and was not said yet.
    std::string stream(double now_s) {
        const std::scoped_lock lock(mutex_);
        std::string said = calibration_due(now_s);
        if (!streams_ || !has_camera)
            next_record_s_ = now_s;
        while (streams_ && has_camera && next_record_s_ <= now_s) {
            said += record(next_record_s_);
            next_record_s_ += 1.0 / rate_hz;
        }
        return said;
    }

    std::vector<std::string> marks() const {
        const std::scoped_lock lock(mutex_);
        return user_data;
    }
    std::string told(const std::string& id) const {
        const std::scoped_lock lock(mutex_);
        const auto found = values.find(id);
        return found == values.end() ? "" : found->second;
    }

  private:
    std::string record(double now_s) {
        const double time_s = now_s + time_offset_s - calibrated_s_;
        const glm::dvec2 place = gaze(now_s);
        const int left = left_is_valid(now_s) ? 1 : 0;
        std::string line = fmt::format(
            "<REC CNT=\"{}\" TIME=\"{:.5f}\" TIME_TICK=\"{}\" LPOGX=\"{:.5f}\" LPOGY=\"{:.5f}\" LPOGV=\"{}\" "
            "RPOGX=\"{:.5f}\" RPOGY=\"{:.5f}\" RPOGV=\"1\" BPOGX=\"{:.5f}\" BPOGY=\"{:.5f}\"BPOGV=\"1\" "
            "LEYEX=\"-0.03\" LEYEY=\"0.01\" LEYEZ=\"0.65\" LPUPILD=\"0.0030\" LPUPILV=\"{}\" RPMM=\"4.00\" "
            "RPMMV=\"1\" />\r\n",
            counter_, time_s, static_cast<long long>((now_s + 77.0) * 1e7), place.x, place.y, left,
            place.x + 0.1, place.y, place.x + 0.05, place.y, left);
        // As a real one: the last that it was told, in one record, and 0 in all others.
        if (tells_user_data && values.contains("ENABLE_SEND_USER_DATA"))
            line.insert(line.size() - 4, fmt::format("USER=\"{}\" ", user_));
        if (user_ != "0")
            borne.push_back(std::exchange(user_, "0"));
        if (mutate)
            line = mutate(std::move(line), counter_);
        ++counter_;
        return line;
    }

    std::string obey(const std::string& command, double now_s) {
        std::string_view text = command;
        while (!text.empty() && (text.back() == '\r' || text.back() == ' '))
            text.remove_suffix(1);
        const auto message = parse_opengaze(text);
        if (!message)
            return "";
        const std::string id(message->value("ID").value_or(""));
        const bool is_set = text.starts_with("<SET");
        if (silent_on.contains(id) && silences_[id]++ < silent_times)
            return "";
        if (refused_on.contains(id))
            return fmt::format("<NACK ID=\"{}\" />\r\n", id);
        if (is_set)
            values[id] = std::string(message->attributes);
        return fmt::format("<ACK ID=\"{}\"{} />\r\n", id, answer_to(id, *message, is_set, now_s));
    }

    std::string answer_to(const std::string& id, const OpenGazeMessage& message, bool is_set, double now_s) {
        const std::string state(message.value("STATE").value_or("0"));
        if (id == "ENABLE_SEND_DATA" && is_set) {
            streams_ = state == "1";
            next_record_s_ = now_s;
        } else if (id == "PRODUCT_ID") {
            return fmt::format(" VALUE=\"GP3HD\" BUS=\"USB3\" RATE=\"{}\"", told_rate);
        } else if (id == "SERIAL_ID") {
            return " VALUE=\"123456789\"";
        } else if (id == "COMPANY_ID") {
            return " VALUE=\"GAZEPOINT\"";
        } else if (id == "API_ID") {
            return " VALUE=\"2.8\"";
        } else if (id == "TIME_TICK_FREQUENCY") {
            return fmt::format(" FREQ=\"{}\"", tick_frequency);
        } else if (id == "SCREEN_SIZE") {
            return " X=\"0\" Y=\"0\" WIDTH=\"1920\" HEIGHT=\"1080\"";
        } else if (id == "USER_DATA") {
            user_ = std::string(message.value("VALUE").value_or(""));
            user_data.push_back(user_);
        } else if (id == "CALIBRATE_CLEAR") {
            points.clear();
        } else if (id == "CALIBRATE_ADDPOINT") {
            if (is_set)
                points.emplace_back(*message.number("X"), *message.number("Y"));
            return fmt::format(" PTS=\"{}\"",
                               told_points.empty() ? std::to_string(points.size()) : told_points);
        } else if (id == "CALIBRATE_START") {
            calibration_begun_s_ = state == "1" ? now_s : -1.0;
            calibration_step_ = 0;
        } else if (id == "CALIBRATE_RESULT_SUMMARY") {
            return fmt::format(" AVE_ERROR=\"19.43\" VALID_POINTS=\"{}\"", points.size());
        }
        return is_set ? fmt::format(" STATE=\"{}\"", state) : "";
    }

    /// Targets of 0.2 s, the first half of it before measuring.
    std::string calibration_due(double now_s) {
        std::string said;
        while (!calibration_hangs && calibration_begun_s_ >= 0.0 &&
               now_s >= calibration_begun_s_ + 0.1 * static_cast<double>(calibration_step_)) {
            const std::size_t point = calibration_step_ / 2;
            if (point == points.size()) {
                said += calibration_result();
                calibrated_s_ = now_s + time_offset_s; // TIME begins anew
                calibration_begun_s_ = -1.0;
                break;
            }
            said += fmt::format("<CAL ID=\"{}\" PT=\"{}\" CALX=\"{:.4f}\" CALY=\"{:.4f}\" />\r\n",
                                calibration_step_ % 2 == 0 ? " CALIB_START_PT" : "CALIB_RESULT_PT", point + 1,
                                points[point].x, points[point].y);
            ++calibration_step_;
        }
        return said;
    }

    std::string calibration_result() const {
        std::string line = "<CAL ID=\"CALIB_RESULT\"";
        int number = 1;
        for (const glm::dvec2& point : points) {
            const glm::dvec2 left = point + left_error, right = point + right_error;
            const int valid = invalid_points.contains(number) ? 0 : 1;
            line +=
                fmt::format(" CALX{0}=\"{1:.5f}\" CALY{0}=\"{2:.5f}\" LX{0}=\"{3:.5f}\" LY{0}=\"{4:.5f}\" "
                            "LV{0}=\"{5}\" RX{0}=\"{6:.5f}\" RY{0}=\"{7:.5f}\" RV{0}=\"1\"",
                            number, point.x, point.y, left.x, left.y, valid, right.x, right.y);
            ++number;
        }
        return line + " />>\r\n";
    }

    mutable std::mutex mutex_;
    std::string command_, user_ = "0";
    std::map<std::string, int> silences_;
    bool streams_ = false;
    int counter_ = 1;
    double next_record_s_ = 0.0, calibrated_s_ = 0.0, calibration_begun_s_ = -1.0;
    std::size_t calibration_step_ = 0;
};

} // namespace overt::test
