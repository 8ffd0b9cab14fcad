#include "experiment/protocol/files/keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/quaternion.hpp>

#include "experiment/motion_phase.h"

namespace overt {

namespace {

constexpr std::array<std::string_view, 10> keyframe_columns{"t_s", "x",  "y",  "z",         "qw",
                                                            "qx",  "qy", "qz", "angle_deg", "light_deg"};

/// A row of the table.
struct Keyframe {
    double t_s = 0.0;
    glm::dvec3 shift{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double angle_deg = 0.0, light_deg = 0.0;
};

class KeyframeReading {
  public:
    KeyframeReading(const DelimitedText& table, const std::string& file, Diagnostics& diagnostics)
        : table_(table), file_(file), diagnostics_(diagnostics) {}

    std::vector<Keyframe> keyframes() {
        read_header();
        std::vector<Keyframe> all;
        for (const auto& row : table_.rows)
            all.push_back(read_row(row));
        const bool has_numbers = is_whole_;
        if (has_numbers && all.front().t_s != 0.0)
            error(cell(table_.rows.front(), "t_s")->place, "the first row is not at t_s = 0");
        for (std::size_t i = 1; has_numbers && i < all.size(); ++i)
            if (!(all[i].t_s > all[i - 1].t_s))
                error(cell(table_.rows[i], "t_s")->place,
                      fmt::format("t_s goes from {} to {}: times have to rise", all[i - 1].t_s, all[i].t_s));
        return is_whole_ ? all : std::vector<Keyframe>{};
    }

  private:
    void error(Place place, std::string message, std::string hint = {}) {
        diagnostics_.error(file_, place, std::move(message), std::move(hint));
        is_whole_ = false;
    }

    void read_header() {
        for (std::size_t i = 0; i < table_.header.size(); ++i) {
            const TextCell& name = table_.header[i];
            const auto column = std::ranges::find(keyframe_columns, name.text);
            if (column == keyframe_columns.end())
                error(name.place, fmt::format("there is no column \"{}\" in a table of places", name.text),
                      fmt::format("its columns are {}", fmt::join(keyframe_columns, ", ")));
            else
                index_[static_cast<std::size_t>(column - keyframe_columns.begin())] = static_cast<int>(i);
        }
        const Place begin = table_.header.front().place;
        if (index_[0] < 0)
            error(begin, "the table has no column t_s", "the time of each place in seconds, from 0 on");
        const auto has = [&](std::size_t column) { return index_[column] >= 0; };
        const int quaternion = has(4) + has(5) + has(6) + has(7);
        if (quaternion != 0 && quaternion != 4)
            error(begin, "a rotation is of the four columns qw, qx, qy and qz",
                  "add those that are missing, or write angle_deg instead");
        if (quaternion != 0 && has(8))
            error(table_.header[static_cast<std::size_t>(index_[8])].place,
                  "the table has angle_deg beside a rotation: which of them holds?", "leave one of them out");
    }

    const TextCell* cell(const std::vector<TextCell>& row, std::string_view name) const {
        const auto column =
            static_cast<std::size_t>(std::ranges::find(keyframe_columns, name) - keyframe_columns.begin());
        return index_[column] < 0 ? nullptr : &row[static_cast<std::size_t>(index_[column])];
    }

    double number(const std::vector<TextCell>& row, std::string_view name) {
        const TextCell* const written = cell(row, name);
        if (!written)
            return 0.0;
        if (const std::optional<double> number = number_in_cell(table_, *written))
            return *number;
        error(written->place, fmt::format("{}: \"{}\" is no number", name, written->text));
        return 0.0;
    }

    Keyframe read_row(const std::vector<TextCell>& row) {
        Keyframe key;
        key.t_s = number(row, "t_s");
        key.shift = {number(row, "x"), number(row, "y"), number(row, "z")};
        key.angle_deg = number(row, "angle_deg");
        key.light_deg = number(row, "light_deg");
        if (const TextCell* const w = cell(row, "qw")) {
            key.rotation =
                glm::dquat(number(row, "qw"), number(row, "qx"), number(row, "qy"), number(row, "qz"));
            constexpr double rounding = 0.01;
            const double length = glm::length(key.rotation);
            if (is_whole_ && std::abs(length - 1.0) > rounding)
                error(w->place, fmt::format("a rotation of length {:.4g}: its four numbers have to be of "
                                            "length 1",
                                            length));
        }
        return key;
    }

    const DelimitedText& table_;
    const std::string& file_;
    Diagnostics& diagnostics_;
    std::array<int, keyframe_columns.size()> index_ = [] {
        std::array<int, keyframe_columns.size()> none{};
        none.fill(-1);
        return none;
    }();
    bool is_whole_ = true;
};

Pose pose_of_keyframe(const Keyframe& key, const Animation& motion) {
    const double turn_deg = motion.angle.value + key.angle_deg;
    const glm::dquat turn = glm::angleAxis(to_radians({turn_deg}).value, glm::dvec3(0.0, 0.0, 1.0));
    const bool is_turn = key.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0) && key.shift == glm::dvec3(0.0);
    return {is_turn ? ObjectPose{{within_half_turn(turn_deg)}}
                    : object_pose_of(key.rotation * turn, key.shift),
            {within_half_turn(key.light_deg)}};
}

Keyframe between_keyframes(const Keyframe& from, const Keyframe& to, double share) {
    const auto mixed = [share](auto one, auto other) { return one + share * (other - one); };
    return {mixed(from.t_s, to.t_s), mixed(from.shift, to.shift),
            glm::slerp(glm::normalize(from.rotation), glm::normalize(to.rotation), share),
            mixed(from.angle_deg, to.angle_deg), mixed(from.light_deg, to.light_deg)};
}

} // namespace

double seconds_of_keyframes(const DelimitedText& table) {
    for (std::size_t i = 0; i < table.header.size(); ++i)
        if (table.header[i].text == "t_s" && !table.rows.empty())
            return number_in_cell(table, table.rows.back()[i]).value_or(0.0);
    return 0.0;
}

std::vector<Pose> poses_of_keyframes(const DelimitedText& table, const Animation& motion,
                                     const std::string& file, Diagnostics& diagnostics) {
    const std::vector<Keyframe> keys = KeyframeReading(table, file, diagnostics).keyframes();
    if (keys.empty())
        return {};
    std::vector<Pose> poses;
    for (int frame = 0; frame < motion.frame_count; ++frame) {
        // Rates that no number of two digits is, such as 59.94 Hz, must not miss a row by rounding.
        constexpr double rounding_s = 1e-9;
        const double t_s = frame / motion.frame_rate_hz;
        const auto after =
            std::ranges::find_if(keys, [&](const Keyframe& key) { return key.t_s > t_s + rounding_s; });
        const Keyframe& from = *(after - 1);
        const double into_s = t_s - from.t_s;
        if (after == keys.end() || motion.between == BetweenKeys::step || into_s < rounding_s)
            poses.push_back(pose_of_keyframe(from, motion));
        else
            poses.push_back(
                pose_of_keyframe(between_keyframes(from, *after, into_s / (after->t_s - from.t_s)), motion));
    }
    if (motion.playback == Playback::cycle && motion.frame_count > 1) {
        if (!is_same_pose(poses.front(), poses.back())) {
            diagnostics.error(
                file, table.rows.back().front().place,
                "the last place is not the first: with playback = \"cycle\" the last frame is the "
                "first again",
                "close the way, or write playback = \"ping-pong\"");
            return {};
        }
        poses.back() = poses.front();
    }
    return poses;
}

} // namespace overt
