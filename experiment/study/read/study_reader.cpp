#include "experiment/study/read/study_reader.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/base/path_inside.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/record/no_stimulus.h"
#include "experiment/record/preview_file.h"
#include "experiment/study/read/answer_reader.h"
#include "experiment/study/read/area_evidence.h"
#include "experiment/study/read/exploration_reader.h"
#include "experiment/study/read/exposure.h"
#include "experiment/study/read/gauge_reader.h"
#include "experiment/study/read/gaze_quality.h"
#include "experiment/study/read/open_sessions.h"
#include "experiment/study/read/point_reader.h"
#include "experiment/study/read/trial_screen_areas.h"

namespace overt {

namespace {

class StudyReader {
  public:
    StudyReader(std::span<const std::filesystem::path> sessions, const SurfaceFor& surface_for,
                const StudyOptions& options, const StudyProgress& progress)
        : surface_for_(surface_for), options_(options), progress_(progress),
          open_(open_sessions(sessions, options.detect_events)) {
        for (std::size_t i = 0; i < open_.size(); ++i)
            add_session(i, sessions[i]);
        name_same_observers();
        study_.surfaces.resize(results().objects.size());
    }

    ReadStudy read() {
        begin_reading();
        for (int object = 0; object < static_cast<int>(study_.surfaces.size()); ++object) {
            const SurfaceLookup* lookup = load_surface(object);
            find_exposure(object, lookup);
            read_trials(object, lookup);
            read_points(object, lookup);
            add_evidence(object);
        }
        collect();
        read_given_answers();
        return std::move(study_);
    }

    std::vector<ReadSession> read_alone() {
        begin_reading();
        for (int object = 0; object < static_cast<int>(study_.surfaces.size()); ++object) {
            read_trials(object, load_surface(object));
            study_.surfaces[static_cast<std::size_t>(object)] = {};
        }
        return std::move(read_);
    }

    ReadStudy join(std::vector<ReadSession> read) {
        read_ = std::move(read);
        for (std::size_t i = 0; i < open_.size(); ++i) {
            if (read_[i].state != state_of(open_[i].record()))
                throw InputError(fmt::format("{}: this session has changed since it was read: read it again",
                                             read_[i].session.string()));
            results().sessions[i].events = read_[i].events;
            open_[i].rest();
        }
        for (int object = 0; object < static_cast<int>(study_.surfaces.size()); ++object) {
            const SurfaceLookup* lookup = load_surface(object);
            find_exposure(object, lookup);
            read_points(object, lookup);
            add_evidence(object);
        }
        collect();
        read_given_answers();
        return std::move(study_);
    }

  private:
    StudyResults& results() { return study_.results; }

    void read_given_answers() {
        std::vector<std::filesystem::path> sessions;
        for (const OpenSession& one : open_)
            sessions.push_back(one.path);
        results().answers.given = read_answers(sessions, options_.same_observer);
        results().reliefs.settings = read_gauge_settings(sessions, options_.same_observer);
        results().explorations.shows = read_explorations(sessions, options_.same_observer);
        results().points.given = points_.rows();
    }

    void read_points(int index, const SurfaceLookup* lookup) {
        for (std::size_t session = 0; session < open_.size(); ++session) {
            for (const TrialRecord& trial : open_[session].presentations)
                if (is_of(session, trial, index))
                    points_.read(open_[session], static_cast<int>(session),
                                 results().sessions[session].observer, trial, index, lookup);
            open_[session].rest();
        }
    }

    void begin_reading() {
        for (std::size_t i = 0; i < open_.size(); ++i) {
            const SessionRecord& record = open_[i].record();
            results().sessions[i].events = record.event_origins();
            read_.push_back({open_[i].path, state_of(record), results().sessions[i].events,
                             std::vector<ReadTrial>(open_[i].presentations.size())});
            open_[i].rest();
        }
    }

    void add_session(std::size_t index, const std::filesystem::path& path) {
        const SessionHeader& header = open_[index].record().header();
        const auto take_levels = [&](const std::string& column, const auto& items, const auto& id) {
            std::vector<std::string>& levels = study_.levels[column];
            for (const auto& item : items) {
                if (std::find(levels.begin(), levels.end(), id(item)) == levels.end())
                    levels.push_back(id(item));
            }
        };
        const auto id_of = [](const auto& item) { return item.id; };
        const Factors factors = factors_of(header);
        for (const Factor& factor : factors.all())
            take_levels(factor.name, factor.levels, [](const FactorLevel& level) { return level.name; });
        if (header.slots.size() > 1)
            take_levels("slot", header.slots, id_of);
        for (int object = 0; object < static_cast<int>(header.objects.size()); ++object) {
            // Where each eye had its picture, those of the eye that is analysed.
            const auto views =
                static_cast<int>(header.objects[static_cast<std::size_t>(object)].cameras.size());
            const int first = header.in_slot({}).view,
                      end = header.display.stereo.empty()
                                ? views
                                : first + static_cast<int>(header.views_of_an_eye());
            for (int view = first; view < end; ++view)
                open_[index].objects[{object, view}] = object_of(index, {object, view});
        }
        results().sessions.push_back(describe_session(open_[index], path));
        open_[index].rest();
    }

    /// Gives sessions the observer that the options take theirs for.
    void name_same_observers() {
        for (const auto& [label, other] : options_.same_observer) {
            const auto is_there = [&](const std::string& wanted) {
                return std::ranges::any_of(open_, [&](const OpenSession& one) {
                    return one.record().header().schedule.observer.label == wanted;
                });
            };
            for (const std::string& wanted : {label, other})
                if (!is_there(wanted))
                    throw InputError(fmt::format("--same-observer {}={}: no session is of observer {}.",
                                                 label, other, wanted));
            for (StudySession& session : results().sessions)
                if (session.observer == label)
                    session.observer = other;
        }
    }

    /// The study's index of a session's object in a view, which is new or was in a session before.
    int object_of(std::size_t session, const ViewedObject& own) {
        const SessionHeader& header = open_[session].record().header();
        for (std::size_t i = 0; i < shown_in_.size(); ++i) {
            const auto [other, index] = shown_in_[i];
            if (is_same_object(open_[other].record().header(), index, header, own))
                return static_cast<int>(i);
        }
        shown_in_.emplace_back(session, own);
        results().objects.push_back(describe_object(header, own));
        return static_cast<int>(results().objects.size()) - 1;
    }

    void read_trials(int index, const SurfaceLookup* lookup) {
        const std::string what =
            fmt::format("reading gaze on {}", results().objects[static_cast<std::size_t>(index)].id);
        const ObjectSurface& surface = study_.surfaces[static_cast<std::size_t>(index)];
        const LightOfStimuli light = load_light(index, lookup);
        struct Job {
            std::size_t session, reader;
        };
        std::vector<Job> jobs;
        int trials = 0;
        for (std::size_t session = 0; session < open_.size(); ++session) {
            for (std::size_t reader = 0; reader < open_[session].readers.size(); ++reader)
                jobs.push_back({session, reader});
            for (const TrialRecord& trial : open_[session].presentations)
                trials += is_of(session, trial, index);
        }
        std::atomic<int> done{0};
        std::mutex progress_mutex;
        parallel_for(static_cast<int>(jobs.size()), [&](int i) {
            const auto [session, reader] = jobs[static_cast<std::size_t>(i)];
            OpenSession& open = open_[session];
            std::optional<SurfaceWays> ways;
            if (surface.coarse)
                ways.emplace(*surface.geometry, *surface.coarse, *surface.coarse_geometry);
            const SessionRecord& record = *open.readers[reader];
            for (std::size_t t = reader; t < open.presentations.size(); t += open.readers.size()) {
                const TrialRecord& trial = open.presentations[t];
                if (!is_of(session, trial, index))
                    continue;
                read_[session].trials[t] =
                    read_trial(record, trial, *open.keys[reader], open.validations,
                               {lookup, surface.geometry != nullptr, ways ? &*ways : nullptr, surface.scale,
                                light_of(light, record.header(), trial)},
                               options_);
                const std::scoped_lock lock(progress_mutex);
                progress_(what, ++done, trials);
            }
            if (open.is_one_of_many)
                record.rest();
        });
    }

    /// Of an object's stimuli by the hashes of their frames, and how the object stands in their pictures,
    /// which is not in what they are made from.
    using LightKey = std::pair<ContentHash, std::vector<std::array<double, 8>>>;
    using LightOfStimuli = std::map<LightKey, LightScores>;

    static LightKey light_key(const SessionHeader& header, const RecordedStimulus& stimulus) {
        LightKey key{stimulus.made_from_sha256 + stimulus.frames_sha256, {}};
        for (const Pose& picture : header.animation_of(stimulus.stimulus).pictures()) {
            const auto& [angle, tilt, shift] = picture.object;
            key.second.push_back({angle.value, tilt.w, tilt.x, tilt.y, tilt.z, shift.x, shift.y, shift.z});
        }
        return key;
    }

    /// Each from the first session that has it. A file that cannot be read is as good as none.
    LightOfStimuli load_light(int index, const SurfaceLookup* lookup) {
        LightOfStimuli light;
        for (std::size_t session = 0; session < open_.size() && lookup; ++session) {
            const SessionRecord& record = open_[session].record();
            const SessionHeader& header = record.header();
            for (const RecordedStimulus& stimulus : header.stimuli) {
                LightKey key = light_key(header, stimulus);
                const auto pictures = static_cast<int>(key.second.size());
                const std::filesystem::path file = record.directory() / light_file(header, stimulus.stimulus);
                const auto own = open_[session].objects.find(viewed(stimulus.stimulus));
                if (own == open_[session].objects.end() || own->second != index || light.contains(key) ||
                    !is_file_inside(record.directory(), light_file(header, stimulus.stimulus)))
                    continue;
                try {
                    light.emplace(
                        std::move(key),
                        LightScores(read_light_pictures(
                            file, header.screen_of_view(stimulus.stimulus.view).image_px, pictures)));
                } catch (const InputError& error) {
                    results().remarks.push_back(
                        fmt::format("The light of a stimulus is left out: {}", error.what()));
                }
            }
        }
        return light;
    }

    static const LightScores* light_of(const LightOfStimuli& light, const SessionHeader& header,
                                       const TrialRecord& trial) {
        // Of what was set to match the light was another at each level.
        const bool is_set = std::ranges::any_of(trial.outcome.given, [&](const GivenAnswer& given) {
            return !given.levels.empty() && given.slot == trial.trial.slot;
        });
        if (is_set)
            return nullptr;
        const RecordedStimulus* const stimulus = stimulus_of(header, header.in_slot(trial.trial.shown(0)));
        const auto found = stimulus ? light.find(light_key(header, *stimulus)) : light.end();
        return found == light.end() ? nullptr : &found->second;
    }

    /// Fixations of all sessions together tell where on the object gaze was.
    void add_evidence(int index) {
        const StudyObject& object = results().objects[static_cast<std::size_t>(index)];
        const ObjectSurface& surface = study_.surfaces[static_cast<std::size_t>(index)];
        if (!object.mesh || object.areas.empty() || !surface.scale)
            return;
        std::vector<StudyFixation*> fixations;
        std::vector<MeasuredPlace> places;
        const SessionHeader* header = nullptr;
        int presentation = 0;
        for (std::size_t session = 0; session < open_.size(); ++session) {
            for (std::size_t t = 0; t < read_[session].trials.size(); ++t) {
                const TrialRecord& trial = open_[session].presentations[t];
                if (!is_of(session, trial, index))
                    continue;
                header = &open_[session].record().header();
                ++presentation;
                const std::optional<double>& accuracy = read_[session].trials[t].trial.quality.accuracy_deg;
                const double sigma_deg =
                    GazeCone(object.screen, Degrees{accuracy.value_or(0.0)}, 1).sigma().value;
                if (!(sigma_deg > 0.0))
                    continue;
                const glm::dvec2 px_per_deg = surface.scale->mm_per_deg * surface.scale->shown_size *
                                              glm::dvec2(object.screen.screen_px) / object.screen.screen_mm;
                for (StudyFixation& fixation : read_[session].trials[t].fixations) {
                    if (!fixation.counted() && fixation.why != NotCounted::not_on_surface)
                        continue;
                    fixations.push_back(&fixation);
                    places.push_back(
                        {fixation.mid_pose,
                         header->screen_of_slot(trial.trial.slot).image_from_screen(fixation.mid_gaze),
                         sigma_deg * px_per_deg, presentation});
                }
            }
        }
        if (fixations.empty())
            return;
        const SceneView scene{{object.camera, object.screen.image_px}, object.mesh->bounds()};
        auto evidence = area_evidence(*object.mesh, object.areas, scene, header->poses.angles, places);
        for (std::size_t i = 0; i < fixations.size(); ++i)
            fixations[i]->evidence = std::move(evidence[i]);
    }

    bool is_of(std::size_t session, const TrialRecord& trial, int object) const {
        const auto own =
            open_[session].objects.find(viewed_in(open_[session].record().header(), trial.trial));
        return trial.gives_results() && own != open_[session].objects.end() && own->second == object;
    }

    /// From the first session that has it whole.
    const SurfaceLookup* load_surface(int index) {
        const SurfaceLookup* lookup = nullptr;
        std::string fault;
        for (std::size_t session = 0; session < open_.size() && !lookup; ++session) {
            const std::map<ViewedObject, int>& own = open_[session].objects;
            const auto found = std::ranges::find(own, index, [](const auto& one) { return one.second; });
            if (found == own.end())
                continue;
            try {
                lookup = surface_for_(open_[session].record(), session, found->first);
            } catch (const Error& error) {
                if (fault.empty())
                    fault = error.what();
            }
        }
        add_surface(lookup, fault, results().objects[static_cast<std::size_t>(index)],
                    study_.surfaces[static_cast<std::size_t>(index)]);
        return lookup;
    }

    /// Adds how long a presentation showed each pose as the observer turned it.
    static void add_turned_seconds(const SessionRecord& record, const TrialRecord& trial,
                                   std::vector<double>& seconds) {
        const double refresh_s = 1.0 / record.header().display.refresh_hz;
        for (const FlipRecord& flip : record.flips(trial))
            if (flip.shown != no_frame && static_cast<std::size_t>(flip.pose.value) < seconds.size())
                seconds[static_cast<std::size_t>(flip.pose.value)] += refresh_s;
    }

    /// How long a presentation of an object shows each pose as planned, by PoseIndex: the mean over the
    /// trials that count, and over all motions if there is none. What observers turned counts as they did.
    std::vector<double> seconds_shown(int index) const {
        const SessionHeader& header =
            open_[shown_in_[static_cast<std::size_t>(index)].first].record().header();
        std::vector<double> trials(header.animations.size(), 0.0);
        std::vector<double> as_turned(header.poses.angles.size(), 0.0);
        // Sessions of one object have the same poses; motions have their numbers in the session.
        for (std::size_t session = 0; session < open_.size(); ++session) {
            for (const TrialRecord& trial : open_[session].presentations) {
                const auto motion = static_cast<std::size_t>(trial.trial.stimulus.motion);
                if (!is_of(session, trial, index) || motion >= trials.size())
                    continue;
                trials[motion] += 1.0;
                if (!header.animations[motion].has_plan())
                    add_turned_seconds(open_[session].record(), trial, as_turned);
            }
        }
        double all = std::accumulate(trials.begin(), trials.end(), 0.0);
        if (!(all > 0.0)) {
            trials.assign(trials.size(), 1.0);
            all = static_cast<double>(trials.size());
        }
        std::vector<double> seconds(header.poses.angles.size(), 0.0);
        for (std::size_t pose = 0; pose < seconds.size(); ++pose)
            seconds[pose] = as_turned[pose] / all;
        const bool is_any_turned =
            std::ranges::any_of(as_turned, [](double turned_s) { return turned_s > 0.0; });
        for (std::size_t motion = 0; motion < trials.size(); ++motion) {
            if (is_any_turned && !header.animations[motion].has_plan())
                continue;
            const std::vector<double> of_motion =
                seconds_of_poses(header.animations[motion], header.poses, static_cast<int>(motion));
            for (std::size_t pose = 0; pose < seconds.size(); ++pose)
                seconds[pose] += trials[motion] / all * of_motion[pose];
        }
        return seconds;
    }

    void find_exposure(int index, const SurfaceLookup* lookup) {
        StudyObject& object = results().objects[static_cast<std::size_t>(index)];
        ObjectSurface& surface = study_.surfaces[static_cast<std::size_t>(index)];
        const auto* maps = dynamic_cast<const CoordinateMaps*>(lookup);
        if (!maps)
            return;
        progress_(fmt::format("exposure of {}", object.id), 0, 1);
        Exposure exposure = exposure_of(*maps, seconds_shown(index));
        if (surface.scale) {
            const ScreenGeometry& screen = object.screen;
            const double px_mm = screen.screen_mm.y / screen.screen_px.y / surface.scale->shown_size;
            for (ExposureRow& row :
                 exposure_rows({exposure, *object.mesh, surface.scale->mm_per_unit, px_mm * px_mm}, index,
                               object.areas))
                results().exposures.push_back(std::move(row));
        }
        object.seconds_visible = std::move(exposure.seconds_visible);
        surface.pixel_seconds = std::move(exposure.pixel_seconds);
        progress_(fmt::format("exposure of {}", object.id), 1, 1);
    }

    /// Everything in the order of sessions and trials, however it was read.
    void collect() {
        bool any_both_eyes = false;
        for (std::size_t session = 0; session < open_.size(); ++session) {
            const std::vector<TrialRecord>& trials = open_[session].presentations;
            for (std::size_t t = 0; t < trials.size(); ++t) {
                if (!trials[t].gives_results())
                    continue;
                ReadTrial& read = read_[session].trials[t];
                const int index = static_cast<int>(results().trials.size());
                read.trial.session = static_cast<int>(session);
                for (StudyKey& key : read.trial.keys)
                    if (key.column == "observer")
                        key.value = results().sessions[session].observer;
                read.trial.object =
                    open_[session].objects.at(viewed_in(open_[session].record().header(), trials[t].trial));
                read.trial.first_fixation = results().fixations.size();
                read.trial.fixations = read.fixations.size();
                for (StudyFixation& fixation : read.fixations) {
                    fixation.trial = index;
                    results().fixations.push_back(fixation);
                }
                if (!read.trace.points.empty()) {
                    read.trace.trial = index;
                    results().traces.push_back(std::move(read.trace));
                }
                any_both_eyes |= read.had_both_eyes;
                if (trials[t].place == 0)
                    results().glance.samples += read.samples;
                results().trials.push_back(std::move(read.trial));
            }
        }
        add_screen_areas();
        for (int session = 0; session < static_cast<int>(open_.size()); ++session) {
            std::vector<const StudyQuality*> own;
            for (const StudyTrial& trial : results().trials) {
                if (trial.session == session)
                    own.push_back(&trial.quality);
            }
            results().session_quality.push_back(quality_of_all(own));
        }
        const std::string no_angles = sentence_on({SessionRecord::EventOrigin::From::no_angles, {}});
        for (const StudySession& session : results().sessions) {
            if (session.events.find(no_angles) != std::string::npos)
                results().remarks.push_back(fmt::format("{}: {}", session.folder, no_angles));
        }
        if (any_both_eyes)
            results().remarks.emplace_back(
                "Of binocular recordings the eye that the session names is taken.");
        remark_on_sessions_without_stimulus();
        for (std::size_t i = 0; i < results().objects.size(); ++i) {
            const std::string& remark = results().objects[i].remark;
            if (!remark.empty() && !knows_no_stimulus(open_[shown_in_[i].first].record().header()))
                results().remarks.push_back(remark);
        }
    }

    /// Those that recordings tell and those of the options, by trial.
    void add_screen_areas() {
        std::vector<std::vector<ScreenArea>>& areas = results().screen_areas;
        std::vector<std::string> files, faults;
        for (const OpenSession& open : open_) {
            for (const TrialRecord& trial : open.presentations) {
                if (!trial.gives_results())
                    continue;
                RecordedScreenAreas recorded = recorded_screen_areas(open.record(), trial);
                for (ScreenArea& chosen :
                     chosen_screen_areas(options_.screen_areas, results().trials[areas.size()]))
                    recorded.areas.push_back(std::move(chosen));
                areas.push_back(std::move(recorded.areas));
                std::ranges::move(recorded.faults, std::back_inserter(faults));
                for (std::string& file : recorded.files)
                    if (std::ranges::find(files, file) == files.end())
                        files.push_back(std::move(file));
            }
            open.rest();
        }
        if (std::ranges::all_of(areas, &std::vector<ScreenArea>::empty))
            areas.clear();
        if (!faults.empty())
            results().remarks.push_back(
                fmt::format("{} on areas of the screen cannot be read and {} left out; the first is {}.",
                            faults.size() == 1 ? "A message" : fmt::format("{} messages", faults.size()),
                            faults.size() == 1 ? "is" : "are", faults.front()));
        if (!files.empty() && options_.screen_areas.empty())
            results().remarks.push_back(fmt::format(
                "Recordings name {} with areas of the screen, such as {}: give such a file with --areas.",
                files.size() == 1 ? "a file" : fmt::format("{} files", files.size()), files.front()));
        const std::vector<std::string> unknown = unknown_columns(options_.screen_areas, results());
        if (!unknown.empty())
            throw InputError(fmt::format(
                "{}: no trial has a column {}: an area is of the trials that have the same word there",
                options_.screen_areas_file, fmt::join(unknown, ", ")));
    }

    /// What is given of them, and what is not.
    void remark_on_sessions_without_stimulus() {
        std::vector<std::string> folders;
        for (std::size_t session = 0; session < open_.size(); ++session) {
            if (knows_no_stimulus(open_[session].record().header()))
                folders.push_back(results().sessions[session].folder);
        }
        if (folders.empty())
            return;
        constexpr std::size_t most_named = 5;
        const std::string named =
            folders.size() > most_named
                ? fmt::format("{} sessions know of no stimulus, as imported recordings do", folders.size())
                : fmt::format("{} {} of no stimulus, as imported recordings do", fmt::join(folders, ", "),
                              folders.size() == 1 ? "knows" : "know");
        results().remarks.push_back(
            named +
            ": fixations with their places on the screen, the quality of gaze, and trials are in the tables "
            "fixations, quality and trials, what gaze did with areas of the screen in screen_areas, where "
            "there are "
            "any; saccades and blinks are in the exports. Maps, shares of parts, comparisons of conditions "
            "on a "
            "surface, gaze on a moving surface and light at gaze were not computed of them: that takes the "
            "object "
            "that was shown, and when.");
        if (results().screen_areas.empty())
            results().remarks.push_back(
                "No area of the screen is known: analyze takes a file of them with --areas, and messages "
                "\"!V IAREA\" of a recording.");
    }

    const SurfaceFor& surface_for_;
    const StudyOptions& options_;
    const StudyProgress& progress_;
    std::vector<OpenSession> open_;
    /// By object: a session that has it, and what it is there.
    std::vector<std::pair<std::size_t, ViewedObject>> shown_in_;
    std::vector<ReadSession> read_; ///< by session
    ReadStudy study_;
    PointReader points_;
};

} // namespace

std::vector<ReadSession> read_sessions(std::span<const std::filesystem::path> sessions,
                                       const SurfaceFor& surface_for, const StudyOptions& options,
                                       const StudyProgress& progress) {
    return StudyReader(sessions, surface_for, options, progress).read_alone();
}

ReadStudy join_sessions(std::vector<ReadSession> read, const SurfaceFor& surface_for,
                        const StudyOptions& options, const StudyProgress& progress) {
    std::vector<std::filesystem::path> sessions;
    for (const ReadSession& one : read)
        sessions.push_back(one.session);
    return StudyReader(sessions, surface_for, options, progress).join(std::move(read));
}

ReadStudy read_study(std::span<const std::filesystem::path> sessions, const SurfaceFor& surface_for,
                     const StudyOptions& options, const StudyProgress& progress) {
    return StudyReader(sessions, surface_for, options, progress).read();
}

} // namespace overt
