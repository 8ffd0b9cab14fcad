#include "experiment/protocol/files/recorded_courses.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace overt {

namespace {

using CourseCells = std::vector<TextCell>;

class CourseReading {
  public:
    CourseReading(const DelimitedText& table, MotionSettings& motion, const std::string& file,
                  Diagnostics& diagnostics)
        : table_(table), motion_(motion), file_(file), diagnostics_(diagnostics) {}

    void run() {
        for (const std::string_view needed : {"trial", "slot", "t_s", "angle_deg"})
            if (!column(needed))
                error(table_.header.front().place, fmt::format("the table has no column {}", needed),
                      "it is written by overt export --format tsv, as courses.tsv");
        if (!is_whole_)
            return;
        for (const CourseCells& row : table_.rows)
            read_row(row);
        if (is_whole_)
            std::ranges::move(courses_, std::back_inserter(motion_.courses));
        if (is_whole_)
            motion_.given = std::move(poses_);
    }

  private:
    void error(Place place, std::string message, std::string hint = {}) {
        diagnostics_.error(file_, place, std::move(message), std::move(hint));
        is_whole_ = false;
    }

    std::optional<std::size_t> column(std::string_view name) const {
        const auto found = std::ranges::find(table_.header, name, &TextCell::text);
        return found == table_.header.end()
                   ? std::nullopt
                   : std::optional(static_cast<std::size_t>(found - table_.header.begin()));
    }

    /// Null where the table has no such column.
    const TextCell* cell(const CourseCells& row, std::string_view name) const {
        const std::optional<std::size_t> index = column(name);
        return index ? &row[*index] : nullptr;
    }

    double number(const CourseCells& row, std::string_view name, double left_out, double least, double most) {
        const TextCell* const written = cell(row, name);
        if (!written)
            return left_out;
        const std::optional<double> number = number_in_cell(table_, *written);
        if (!number)
            error(written->place, fmt::format("{}: \"{}\" is no number", name, written->text));
        else if (!(*number >= least && *number <= most))
            error(written->place,
                  fmt::format("{} is {:g}, which is outside {:g} … {:g}", name, *number, least, most));
        else
            return *number;
        return left_out;
    }

    int whole(const CourseCells& row, std::string_view name) {
        constexpr double most = 1e6;
        const double written = number(row, name, 1.0, 1.0, most);
        if (written != std::round(written))
            error(cell(row, name)->place, fmt::format("{}: {:g} is no whole number", name, written));
        return static_cast<int>(written);
    }

    /// What a row says of its show.
    RecordedCourse show_of(const CourseCells& row) {
        RecordedCourse course;
        const TextCell* const observer = cell(row, "observer");
        course.whose = fmt::format("{} session {}",
                                   observer ? observer->text : std::filesystem::path(file_).stem().string(),
                                   whole(row, "session"));
        course.trial = whole(row, "trial");
        course.slot = cell(row, "slot")->text;
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
            if (const TextCell* const id = cell(row, stimulus_lists[list].name);
                id && stimulus_lists[list].index != &Stimulus::motion)
                course.stimulus[list] = id->text;
        return course;
    }

    void read_row(const CourseCells& row) {
        constexpr double longest_s = 3600.0, most_turn_deg = 720.0, most_tilt_deg = 90.0;
        const bool was_whole = std::exchange(is_whole_, true);
        RecordedCourse show = show_of(row);
        const double t_s = number(row, "t_s", 0.0, 0.0, longest_s);
        const ObjectPose pose =
            turned_and_tilted({number(row, "angle_deg", 0.0, -most_turn_deg, most_turn_deg)},
                              {number(row, "elevation_deg", 0.0, -most_tilt_deg, most_tilt_deg)});
        const bool is_sound = is_whole_, is_first = t_s == 0.0;
        is_whole_ = was_whole && is_sound;
        // Of a show whose first row is wrong the others say nothing new.
        is_first_lost_ = is_first ? !is_sound : is_first_lost_;
        if (!is_sound || is_first_lost_)
            return;
        if (is_first)
            courses_.push_back(std::move(show));
        else if (courses_.empty() || courses_.back().name() != show.name() ||
                 courses_.back().slot != show.slot)
            return error(
                cell(row, "t_s")->place,
                fmt::format("the first row of {} in slot \"{}\" is not at t_s = 0", show.name(), show.slot));
        RecordedCourse& course = courses_.back();
        if (!is_first && !(t_s > course.lasts_s))
            return error(cell(row, "t_s")->place,
                         fmt::format("t_s goes from {} to {}: times have to rise", course.lasts_s, t_s));
        course.lasts_s = t_s;
        const AnimationFrameIndex frame = frame_of(pose);
        if (is_first || frame != course.turns.back().frame)
            course.turns.push_back({t_s, frame});
    }

    AnimationFrameIndex frame_of(const ObjectPose& pose) {
        const auto found = std::ranges::find_if(
            poses_, [&](const Pose& one) { return is_same_object_pose(one.object, pose); });
        const auto frame = static_cast<int>(found - poses_.begin());
        if (found == poses_.end())
            poses_.push_back({pose, {}});
        return {frame};
    }

    const DelimitedText& table_;
    MotionSettings& motion_;
    const std::string& file_;
    Diagnostics& diagnostics_;
    std::vector<RecordedCourse> courses_;
    std::vector<Pose> poses_ = motion_.given;
    bool is_whole_ = true, is_first_lost_ = false;
};

} // namespace

void add_courses(const DelimitedText& table, MotionSettings& motion, const std::string& file,
                 Diagnostics& diagnostics) {
    CourseReading(table, motion, file, diagnostics).run();
}

} // namespace overt
