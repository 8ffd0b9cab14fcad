/// What is asked, of whom, and in which order, as a protocol states it. Explained key by key in
/// design_keys.cpp and order_keys.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/answers/task_answer.h"
#include "experiment/base/enum_names.h"
#include "experiment/base/named_words.h"
#include "experiment/protocol/point_settings.h"
#include "experiment/protocol/step_settings.h"
#include "experiment/protocol/trials_settings.h"
#include "experiment/stimulus_lists.h"

namespace overt {

/// Which stimuli a task is asked for.
enum class TaskCoverage : std::uint8_t { every_stimulus, once_per_object };
template <>
inline constexpr auto names_of<TaskCoverage> = enum_names<TaskCoverage>("every-stimulus", "once-per-object");

/// Shares by the names of areas.
using AreaShares = std::vector<std::pair<std::string, double>>;

/// [[task]]
struct Task {
    std::string id;
    std::string question;
    TaskCoverage stimuli = TaskCoverage::every_stimulus;
    // Shares of a simulated observer's fixations: see simulated_shares().
    std::optional<double> simulated_head_share{};
    AreaShares simulated_area_shares{};
    std::vector<std::string> slots = {}; ///< see slots_of_task()
    /// None: the question, a drift check, the stimulus, the answer.
    std::vector<StepSettings> steps = {};
    TrialsSettings trials = {};             ///< neither a rule nor a file: every stimulus, by `stimuli`
    std::filesystem::path trials_file = {}; ///< of a table; resolved against the protocol's folder
    CatchSettings catch_trials = {};
    int repetitions = 1;                  ///< how often each of its trials comes
    std::vector<TaskAnswer> answers = {}; ///< none: the answer is spoken
    std::vector<ProbeSettings> probes = {};
    std::optional<int> draw_points = {}; ///< so many of what its probes' points give, drawn for each observer
};

/// Where simulated observers look for a task: the shares that go to areas, each once, the head first. A task
/// that says nothing gives the head usual_head_share; what the areas leave goes to the rest of the surface,
/// by area.
AreaShares simulated_shares(const Task& task);
inline constexpr double usual_head_share = 0.4;

/// Most areas with shares, of all tasks together, and the head.
inline constexpr std::size_t most_simulated_areas = 32;

/// For each of `stimulus_lists`, the ids of the entries that are chosen; none: all.
using ChosenEntries = std::array<std::vector<std::string>, stimulus_lists.size()>;
/// For each of `stimulus_lists`, one id; what an empty one means is said where it stands.
using EntryOfEach = std::array<std::string, stimulus_lists.size()>;

/// How the trials of a block come.
enum class OrderMethod : std::uint8_t {
    random,     ///< every order equally probable
    sequential, ///< as listed
    blocked,    ///< all trials of one level of a factor, then all of the next
    weighted    ///< levels of a factor come more or less often
};
template <>
inline constexpr auto names_of<OrderMethod> = enum_names<OrderMethod>("random", "sequential", "blocked",
                                                                      "weighted");

/// Latin squares, of which each observer takes a row (latin_square.h).
enum class SquareKind : std::uint8_t { cyclic, balanced, random_square };
template <>
inline constexpr auto names_of<SquareKind> = enum_names<SquareKind>("cyclic", "balanced", "random-square");

/// In which order levels come, or blocks: drawn for each session, the same for all observers, or the row of a
/// Latin square.
enum class LevelOrder : std::uint8_t { random, fixed, cyclic, balanced, random_square };
template <>
inline constexpr auto names_of<LevelOrder> = enum_names<LevelOrder>("random", "fixed", "cyclic", "balanced",
                                                                    "random-square");

/// Whether one repetition is over before the next begins.
enum class RepetitionOrder : std::uint8_t { in_turn, mixed };
template <> inline constexpr auto names_of<RepetitionOrder> = enum_names<RepetitionOrder>("in-turn", "mixed");

/// [schedule]
struct ScheduleSettings {
    int observers = 12;                ///< planned number
    std::optional<std::uint64_t> seed; ///< left out: drawn for each session, and recorded
    // Longest run of trials with the same …; 0: no limit.
    int max_task_run = 0;
    int max_object_run = 2;
    int max_material_run = 0;
    int max_stimulus_run = 0;
    // Least distance of trials with the same …, in trials; 0: no limit.
    int min_task_distance = 0;
    int min_object_distance = 0;
    int min_material_distance = 0;
    int min_stimulus_distance = 0;
    // The same by name, for any factor.
    NamedNumbers max_run, min_distance;
    std::string rotated_list = "material"; ///< of tasks that are asked once per object
    SquareKind material_rotation = SquareKind::cyclic;
    LevelOrder block_order = LevelOrder::fixed;
    int rotation_seed = 1; ///< of random squares, which all observers share
};

/// `criterion` of a block: it is over once so many of its last answers were correct.
struct CriterionSettings {
    int correct = 0; ///< 0: there is none
    int of_last = 0; ///< trials that count, one after the other; 0: as many as have to be correct
    int at_least = 0;
    bool is_written() const { return correct > 0; }
    int last() const { return of_last > 0 ? of_last : correct; }
};

/// [[block]]
struct BlockSettings {
    std::string id;
    std::vector<std::string> tasks; ///< left out: all
    ChosenEntries chosen;
    std::optional<TaskCoverage> stimuli; ///< left out: as each task says
    OrderMethod order = OrderMethod::random;
    std::string by = "task";                ///< a factor, of blocked and weighted orders
    LevelOrder levels = LevelOrder::random; ///< of a blocked order
    std::vector<double> weights;            ///< of a weighted order, by level
    std::optional<int> draws;               ///< trials drawn with replacement, of a weighted order
    int repetitions = 1;
    RepetitionOrder repetition_order = RepetitionOrder::in_turn;
    std::string instructions; ///< shown before it; empty: nothing
    bool continues = false;   ///< limits count the trials of the block before, too
    DrawSettings draw = {};
    CriterionSettings criterion = {};
    std::string feedback = {}; ///< shown after it, with what was answered; empty: nothing
    bool practice = false;     ///< all is recorded of its trials, and results are not of them
    NamedNumbers max_run, min_distance;
    std::optional<int> max_task_run, max_object_run, max_material_run, max_stimulus_run;
    std::optional<int> min_task_distance, min_object_distance, min_material_distance, min_stimulus_distance;
};

/// [[group]]: of observers, who differ in what they see.
struct GroupSettings {
    std::string id;
    int cap = 0;                            ///< most observers; 0: no limit
    std::vector<std::string> blocks, tasks; ///< left out: all
    ChosenEntries chosen;
};

/// [simulated_observers]: how they differ from one another.
struct SimulatedObserverSettings {
    /// Standard deviation of the logit of their shares of fixations on the head, and on each other area that
    /// has a share.
    double head_share_sd = 0.0;
};

/// [[simulated_effect]]: what the gaze of simulated observers depends on, for a study to find.
struct SimulatedEffect {
    std::string task;        ///< an id; empty: any
    EntryOfEach entries;     ///< ids; empty: any
    NamedWords where;        ///< levels of other factors
    double head_odds = 1.0;  ///< times the odds of the task's share of the head
    double spot_share = 0.0; ///< share of fixations that go to the effect's own spot
    /// How far from the object's middle the other fixations lie: places at r times the usual distance are
    /// looked at exp(spread r^2) times as often; 0: by area alone.
    double spread = 0.0;
    std::string area{};     ///< of area_odds
    double area_odds = 1.0; ///< times the odds of the task's share of the area
    // On what is answered (AnswerTruth).
    std::string answer{};      ///< id of an answer; empty: of none
    double answer_shift = 0.0; ///< on top of the judgement of such stimuli, in its units
    double answer_slope = 1.0; ///< times the slope, or the gain, in trials that show no others
    double answer_odds = 1.0;  ///< times the odds of a correct choice that goes by no factor
};
/// Effects with a spot that one trial can have.
inline constexpr int most_simulated_spots = 8;

/// [[practice]]: a trial that does not count. Ids.
struct PracticeSettings {
    std::string task;
    EntryOfEach entries;  ///< empty: the first of the list
    std::string block;    ///< that it comes before; empty: the first
    std::string feedback; ///< shown after the answer; empty: nothing
};

enum class BreakPace : std::uint8_t { self, timed };
template <> inline constexpr auto names_of<BreakPace> = enum_names<BreakPace>("self", "timed");

/// [breaks]
struct BreakSettings {
    int every_trials = 0; ///< 0: none
    bool between_blocks = false;
    BreakPace pace = BreakPace::self;
    double duration_s = 60.0;
    double min_s = 5.0;
    std::string text = "# Time for a rest\nRest your eyes as long as you like.";
};

/// When a trial that failed comes again.
enum class RepeatWhen : std::uint8_t { never, now, end_of_block };
template <>
inline constexpr auto names_of<RepeatWhen> = enum_names<RepeatWhen>("never", "now", "end-of-block");

/// [repeat]
struct RepeatSettings {
    RepeatWhen missed_refreshes = RepeatWhen::never;
    int missed_refreshes_limit = 0; ///< more than these fail
    RepeatWhen gaze_lost = RepeatWhen::never;
    double gaze_lost_limit = 0.3; ///< a larger share of samples without gaze fails
    RepeatWhen rejected = RepeatWhen::end_of_block;
    int most_attempts = 3;
};

} // namespace overt
