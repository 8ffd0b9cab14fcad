#include "experiment/study/read/study_shard.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

/// Another one for each change of what follows it.
constexpr std::string_view shard_magic = "overt shard of a study, version 4\n";
constexpr std::size_t hash_length = 64;

// What is in a shard, once for writing and reading. A member that is added breaks the build here.
template <class Archive> void fields(Archive& archive, StudyKey& key) {
    auto& [column, value] = key;
    archive(column, value);
}
template <class Archive> void fields(Archive& archive, StudyParameter& parameter) {
    auto& [name, value, unit, meaning] = parameter;
    archive(name, value, unit, meaning);
}
template <class Archive> void fields(Archive& archive, ScreenPoint& point) {
    auto& [x, y] = point;
    archive(x, y);
}
template <class Archive> void fields(Archive& archive, PoseIndex& pose) {
    auto& [value] = pose;
    archive(value);
}
template <class Archive> void fields(Archive& archive, AreaEvidence& evidence) {
    auto& [inside, elsewhere] = evidence;
    archive(inside, elsewhere);
}
template <class Archive> void fields(Archive& archive, glm::dvec3& point) {
    archive(point.x, point.y, point.z);
}
template <class Archive> void fields(Archive& archive, StudyTurn& turn) {
    auto& [time_s, angle_deg, frame] = turn;
    archive(time_s, angle_deg, frame);
}
template <class Archive> void fields(Archive& archive, StudyTracePoint& point) {
    auto& [time_s, gaze, pupil] = point;
    archive(time_s, gaze, pupil);
}
template <class Archive> void fields(Archive& archive, StudyTraceEvent& event) {
    auto& [kind, onset_s, duration_s, amplitude_deg, peak_velocity_deg_s] = event;
    archive(kind, onset_s, duration_s, amplitude_deg, peak_velocity_deg_s);
}
template <class Archive> void fields(Archive& archive, StudyTrace& trace) {
    auto& [trial, points, events] = trace;
    archive(trial, points, events);
}
template <class Archive> void fields(Archive& archive, StudyQuality& quality) {
    auto& [accuracy, worst, drift, rms, sd, rate, samples, lost, in_blinks, blinks, refreshes, missed,
           off_plan] = quality;
    archive(accuracy, worst, drift, rms, sd, rate, samples, lost, in_blinks, blinks, refreshes, missed,
            off_plan);
}
template <class Archive> void fields(Archive& archive, StudyTrial& trial) {
    auto& [session, object, label, number, keys, presentation_s, excluded, why, first_fixation, fixations,
           turns, clock_uncertainty_s, quality, has_gaze] = trial;
    archive(session, object, label, number, keys, presentation_s, excluded, why, first_fixation, fixations,
            turns, clock_uncertainty_s, quality, has_gaze);
}
template <class Archive> void fields(Archive& archive, FixationLight& light) {
    auto& [met, at_place, at_point] = light;
    archive(met, at_place, at_point);
}
template <class Archive> void fields(Archive& archive, StudyFixation::DisplacedMotion& motion) {
    auto& [with_surface, way] = motion;
    archive(with_surface, way);
}
template <class Archive> void fields(Archive& archive, StudyFixation& fixation) {
    auto& [trial, onset_s, duration_s, place, why, samples, on_surface, within_reach, only_by_reach,
           first_frame, last_frame, mid_angle, mid_pose, mid_gaze, evidence, triangle, barycentric, position,
           part, spread_mm, spread_deg, sigma_mm, mm_per_deg, at_edge, cone_mm, with_surface, way, displaced,
           speed, light, lut_mm] = fixation;
    archive(trial, onset_s, duration_s, place, why, samples, on_surface, within_reach, only_by_reach,
            first_frame, last_frame, mid_angle, mid_pose, mid_gaze, evidence, triangle, barycentric, position,
            part, spread_mm, spread_deg, sigma_mm, mm_per_deg, at_edge, cone_mm, with_surface, way, displaced,
            speed, light, lut_mm);
}
template <class Archive> void fields(Archive& archive, ReadTrial& read) {
    auto& [trial, fixations, trace, samples, had_both_eyes] = read;
    archive(trial, fixations, trace, samples, had_both_eyes);
}
template <class Archive> void fields(Archive& archive, ReadSession& read) {
    auto& [session, state, events, trials] = read;
    archive(session, state, events, trials);
}
template <class Archive> void fields(Archive& archive, StudyShard& shard) {
    auto& [number, count, sessions, parameters, read] = shard;
    archive(number, count, sessions, parameters, read);
}

template <class T> constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Of the words that a shard has as numbers: another number is no word.
template <class T> constexpr T last_of() = delete;
template <> constexpr NotCounted last_of() { return NotCounted::no_stimulus; }
template <> constexpr GazeEvent::Kind last_of() { return GazeEvent::Kind::blink; }

class ShardWriter {
  public:
    template <class... Items> void operator()(Items&... items) { (put(items), ...); }
    std::string bytes{shard_magic};

  private:
    template <class T> void put(T& item) {
        if constexpr (is_plain<T>)
            bytes.append(reinterpret_cast<const char*>(&item), sizeof item);
        else
            fields(*this, item);
    }
    void put(std::string& text) {
        auto size = static_cast<std::uint64_t>(text.size());
        put(size);
        bytes += text;
    }
    void put(std::filesystem::path& path) {
        std::string text = path.string();
        put(text);
    }
    template <class T> void put(std::vector<T>& items) {
        auto size = static_cast<std::uint64_t>(items.size());
        put(size);
        for (T& item : items)
            put(item);
    }
    template <class T> void put(std::optional<T>& item) {
        bool is_there = item.has_value();
        put(is_there);
        if (item)
            put(*item);
    }
};

class ShardReader {
  public:
    ShardReader(std::string_view bytes, std::string file) : left_(bytes), file_(std::move(file)) {}
    template <class... Items> void operator()(Items&... items) { (take(items), ...); }
    bool is_at_end() const { return left_.empty(); }

  private:
    [[noreturn]] void throw_damaged() const {
        throw RecordError(fmt::format("{}: this shard is damaged: make it again.", file_));
    }
    const char* next(std::uint64_t size) {
        if (size > left_.size())
            throw_damaged();
        const char* at = left_.data();
        left_.remove_prefix(static_cast<std::size_t>(size));
        return at;
    }
    template <class T> void take(T& item) {
        if constexpr (std::is_same_v<T, bool>)
            item = one_of<std::uint8_t>(1) != 0;
        else if constexpr (std::is_enum_v<T>)
            item = static_cast<T>(
                one_of<std::underlying_type_t<T>>(static_cast<std::underlying_type_t<T>>(last_of<T>())));
        else if constexpr (is_plain<T>)
            std::memcpy(&item, next(sizeof item), sizeof item);
        else
            fields(*this, item);
    }
    /// A number from 0 to `last`.
    template <class Number> Number one_of(Number last) {
        Number number;
        std::memcpy(&number, next(sizeof number), sizeof number);
        if (number < 0 || number > last)
            throw_damaged();
        return number;
    }
    void take(std::string& text) {
        std::uint64_t size = 0;
        take(size);
        text.assign(next(size), static_cast<std::size_t>(size));
    }
    void take(std::filesystem::path& path) {
        std::string text;
        take(text);
        path = text;
    }
    template <class T> void take(std::vector<T>& items) {
        std::uint64_t size = 0;
        take(size);
        // Each item takes a byte at least.
        if (size > left_.size())
            next(size);
        items.resize(static_cast<std::size_t>(size));
        for (T& item : items)
            take(item);
    }
    template <class T> void take(std::optional<T>& item) {
        bool is_there = false;
        take(is_there);
        if (is_there)
            take(item.emplace());
    }

    std::string_view left_;
    std::string file_;
};

std::string words_of(const StudyParameter& parameter) {
    return fmt::format("--{} {}{}", parameter.name, parameter.value, parameter.unit);
}

} // namespace

bool is_shard(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / shard_file_name);
}

std::vector<StudyParameter> reading_parameters(const StudyOptions& options) {
    static const std::vector<std::string> of_reading{"sigma",      "shortest-fixation", "least-on-surface",
                                                     "reach",      "most-lost",         "most-accuracy",
                                                     "most-drift", "most-missed",       "detect-events"};
    std::vector<StudyParameter> parameters = parameters_of(options);
    std::erase_if(parameters, [](const StudyParameter& one) {
        return std::ranges::find(of_reading, one.name) == of_reading.end();
    });
    return parameters;
}

void write_shard(const std::filesystem::path& folder, StudyShard shard) {
    ShardWriter writer;
    writer(shard);
    write_whole_file(folder / shard_file_name, writer.bytes + hash_of_text(writer.bytes));
}

StudyShard read_shard(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / shard_file_name;
    const std::string text = read_whole_file(file);
    const std::string_view bytes(text);
    if (!bytes.starts_with(shard_magic.substr(0, shard_magic.find(','))))
        throw InputError(fmt::format("{}: this is no shard of a study.", file.string()));
    if (!bytes.starts_with(shard_magic))
        throw InputError(fmt::format(
            "{}: this shard was made by another version of the program: make it again.", file.string()));
    if (bytes.size() < shard_magic.size() + hash_length ||
        hash_of_text(bytes.substr(0, bytes.size() - hash_length)) != bytes.substr(bytes.size() - hash_length))
        throw RecordError(fmt::format("{}: this shard is damaged: make it again.", file.string()));
    ShardReader reader(bytes.substr(shard_magic.size(), bytes.size() - shard_magic.size() - hash_length),
                       file.string());
    StudyShard shard;
    reader(shard);
    if (!reader.is_at_end() || shard.number < 1 || shard.number > shard.count)
        throw RecordError(fmt::format("{}: this shard is damaged: make it again.", file.string()));
    return shard;
}

std::vector<ReadSession> joined_shards(std::vector<StudyShard> shards, const std::vector<std::string>& names,
                                       const StudyOptions& options) {
    OVERT_EXPECTS(!shards.empty() && shards.size() == names.size());
    const StudyShard& first = shards.front();
    const std::vector<StudyParameter> wanted = reading_parameters(options);
    std::vector<std::size_t> at(static_cast<std::size_t>(first.count), shards.size());
    for (std::size_t i = 0; i < shards.size(); ++i) {
        const StudyShard& shard = shards[i];
        if (shard.count != first.count)
            throw InputError(
                fmt::format("{} is one of {} shards, and {} one of {}: they are of different studies.",
                            names[i], shard.count, names[0], first.count));
        if (shard.sessions != first.sessions) {
            const auto other = std::ranges::mismatch(shard.sessions, first.sessions);
            throw InputError(fmt::format(
                "{} and {} are shards of different studies: the session {} is in one where the other has {}.",
                names[i], names[0], other.in1 != shard.sessions.end() ? *other.in1 : "none",
                other.in2 != first.sessions.end() ? *other.in2 : "none"));
        }
        for (std::size_t p = 0; p < std::min(wanted.size(), shard.parameters.size()); ++p) {
            if (shard.parameters[p].value != wanted[p].value || shard.parameters[p].unit != wanted[p].unit)
                throw InputError(fmt::format(
                    "{} was read with {}, and here stands {}: give the same, or make the shards again.",
                    names[i], words_of(shard.parameters[p]), words_of(wanted[p])));
        }
        std::size_t& place = at[static_cast<std::size_t>(shard.number - 1)];
        if (place != shards.size())
            throw InputError(fmt::format("{} and {} are both shard {}/{}: its sessions would count twice.",
                                         names[place], names[i], shard.number, shard.count));
        place = i;
    }
    std::vector<std::string> missing;
    for (int number = 1; number <= first.count; ++number) {
        if (at[static_cast<std::size_t>(number - 1)] == shards.size())
            missing.push_back(fmt::format("{}/{}", number, first.count));
    }
    if (!missing.empty())
        throw InputError(
            fmt::format("{} missing: shard {}. Give all of them.",
                        missing.size() == 1 ? "a shard is" : fmt::format("{} shards are", missing.size()),
                        fmt::join(missing, ", ")));
    std::vector<ReadSession> read;
    const std::size_t sessions = first.sessions.size(), count = shards.size();
    for (std::size_t session = 0; session < sessions; ++session) {
        std::vector<ReadSession>& own = shards[at[session % count]].read;
        if (session / count >= own.size() || own[session / count].session != first.sessions[session])
            throw RecordError(
                fmt::format("{}: this shard is damaged: make it again.", names[at[session % count]]));
        read.push_back(std::move(own[session / count]));
    }
    return read;
}

} // namespace overt
