/// What an experiment amounts to before anyone sits down: counts, times, angles, balance, order of trials.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/checks/design_words.h"
#include "experiment/checks/recording_size.h"
#include "experiment/checks/rotation_balance.h"
#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/disparity.h"
#include "experiment/stimulus/object_size.h"
#include "experiment/trial.h"

namespace overt {

/// What a protocol does not say, but a session's length and size depend on.
struct DesignAssumptions {
    double calibration_s = 180.0; ///< calibrating and validating once a session
    double text_s = 20.0;         ///< reading the consent, a page, or the instructions of a block
    double question_s = 4.0;      ///< reading a question; screens.task_min_s if that is longer
    double answer_s = 10.0;       ///< answering aloud, kept within response_min_s … response_max_s
};

/// Of a motion.
struct AnimationFacts {
    std::string id;
    Animation motion;
    int frames = 0;
    int distinct_poses = 0; ///< pictures that differ, by the object's turn or the light's
    int shown_frames = 0;
    int refreshes_per_frame = 0;
    int refreshes = 0; ///< of one presentation
    double duration_s = 0.0;
    double periods = 0.0; ///< swings to and fro in one presentation
    /// What a motion of kind "recorded" shows again.
    struct Recording {
        std::string whose;
        int trials = 0;
        double shortest_s = 0.0, longest_s = 0.0; ///< of its shows
    };
    std::vector<Recording> recordings = {};
};

struct VisualAngles {
    double screen_width_deg = 0.0, screen_height_deg = 0.0;
    double image_width_deg = 0.0, image_height_deg = 0.0; ///< where it is shown
    double image_right_deg = 0.0, image_up_deg = 0.0;     ///< from the screen's middle to the image's
    double camera_fov_deg = 0.0;                          ///< vertical
    double px_per_deg = 0.0;                              ///< at the middle of the screen
};

/// Of one session, by what is on the screen.
struct SessionLength {
    double calibration_s = 0.0, questions_s = 0.0, drift_checks_s = 0.0, animations_s = 0.0, answers_s = 0.0;
    double practice_s = 0.0; ///< whole practice trials with their feedback
    double breaks_s = 0.0;
    double instructions_s = 0.0; ///< of blocks
    int breaks = 0;
    double total_s() const {
        return calibration_s + questions_s + drift_checks_s + animations_s + answers_s + practice_s +
               breaks_s + instructions_s;
    }
};

/// Pages on the graphics card, and one map for each distinct pose of an object.
struct MemoryNeed {
    double pages_per_stimulus_bytes = 0.0; ///< of the stimulus that has most
    bool next_fits = true;                 ///< the frame store has room for the next stimulus, too
    /// Pages that are kept of a stimulus that comes from disk while it is shown (is_streamed); 0: none does.
    int streamed_pages_kept = 0;
    double maps_per_object_bytes = 0.0;
    double pages_at_once_bytes() const { return (next_fits ? 2.0 : 1.0) * pages_per_stimulus_bytes; }
};

/// How often a stimulus is shown under a task, summed over the planned observers.
struct IncidenceCell {
    int task = 0;
    Stimulus stimulus;
    int presentations = 0;
};

/// A block of the protocol, or the only one.
struct BlockFacts {
    std::string id;    ///< empty if the protocol has no blocks
    std::string order; ///< "random", "blocked by task, levels balanced", …
    int trials = 0;    ///< of the observer who has most
};

/// A group of observers.
struct GroupFacts {
    std::string id;
    int cap = 0;       ///< 0: no limit
    int observers = 0; ///< of the planned ones
    int trials = 0;    ///< of each
};

/// An object's surface, as statistics will have it.
struct SurfaceFacts {
    std::string object; ///< id
    std::size_t triangles = 0;
    ObjectSize size;
    std::vector<std::pair<std::string, double>> part_shares; ///< of the area, by name; sum 1
    std::optional<DisparityRange> disparity = {};            ///< between two eyes' pictures
};

/// All that `overt check` says about a sound protocol. Indices are those of the protocol's lists.
struct DesignReport {
    std::string name, title;
    std::vector<std::string> tasks, objects, materials; ///< ids
    Factors factors;
    int trials_per_observer = 0;     ///< of the planned observer who has most
    int fewest_trials = 0;           ///< of the one who has fewest
    int observers = 0;               ///< planned
    std::vector<std::string> blocks; ///< ids; empty if the protocol has none
    std::vector<BlockFacts> block_facts;
    std::vector<std::string> slots; ///< ids
    std::vector<TaskWords> trials;  ///< each task in each block, in plain words
    std::vector<GroupFacts> groups;
    int practice_trials = 0;

    DisplaySettings display;
    StereoSettings stereo;
    ViewSettings view;
    /// A place for a stimulus, with the image in it.
    struct SlotFacts {
        std::string id;
        ScreenGeometry screen;
    };
    std::vector<SlotFacts> slot_places; ///< none without [[slot]]
    std::vector<AnimationFacts> motions;
    VisualAngles angles;
    DesignAssumptions assumptions;
    SessionLength session;
    MemoryNeed memory;

    // To be filled in where the meshes are loaded.
    std::vector<SurfaceFacts> surfaces; ///< of objects with a mesh
    std::optional<RecordingSize> recording;

    std::vector<IncidenceCell> incidence; ///< task by task, stimulus by stimulus
    std::vector<RotationFacts> rotations; ///< of each group in which anything goes round
    std::vector<Schedule> schedules;
    std::vector<std::string> schedule_groups; ///< of each of their observers; empty without groups
    bool is_seed_fixed = false; ///< otherwise the schedules are examples: each session draws its own
    bool is_seed_given = false; ///< somebody asked for the orders of this seed

    std::vector<std::string> warnings; ///< where cells of a task are not filled equally
};

/// Reckons all of it. `observers` are those whose order is shown; if the protocol fixes no seed, the orders
/// are the ones that `example_seed` gives; with `takes_seed` they are so in any case. Throws InputError as
/// make_schedule does.
DesignReport make_design_report(const Protocol& protocol, const std::vector<Observer>& observers,
                                std::uint64_t example_seed = 1, const DesignAssumptions& assumptions = {},
                                bool takes_seed = false);

/// The planned observers, 1 … schedule.observers, labelled "01", "02", ….
std::vector<Observer> planned_observers(const Protocol& protocol);

/// For a terminal of 100 columns: sentences, the balance table, and the order of trials; a table if it is one
/// observer's, else a line of codes each.
std::string to_text(const DesignReport& report);

nlohmann::ordered_json to_json(const DesignReport& report);

} // namespace overt
