/// All that a study of one observer or fifty gives: what tables, figures and the report show. Plain data;
/// analyze_study() fills it in, and nothing reckons with it afterwards.
///
/// Places, lengths, areas and densities on surfaces are in the object's own millimetres (object_scale.h),
/// which StudyObject::mm_per_unit makes of the mesh's unit. Angles are of the observer's eye.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/gaze_event.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/mesh.h"
#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"
#include "experiment/statistics/estimate.h"
#include "experiment/statistics/paired_evidence.h"
#include "experiment/study/results/answer_rows.h"
#include "experiment/study/results/exploration_rows.h"
#include "experiment/study/results/looking_rows.h"
#include "experiment/study/results/point_rows.h"
#include "experiment/study/results/relief_rows.h"
#include "experiment/study/results/screen_area_rows.h"
#include "experiment/study/results/session_setup.h"
#include "experiment/study/results/study_key.h"
#include "experiment/study/results/template_rows.h"

namespace overt {

/// What was set, for the methods' text: every parameter that decides a number.
struct StudyParameter {
    std::string name;    ///< as the option has it, "sigma"
    std::string value;   ///< "1"
    std::string unit;    ///< "deg"; empty: none
    std::string meaning; ///< a whole sentence
};

/// One session as it was read.
struct StudySession {
    std::string folder;         ///< its name, without folders above
    std::string observer;       ///< label
    int number = 1;             ///< of this observer's sessions
    std::string protocol;       ///< title
    std::vector<StudyKey> form; ///< what the observer filled in
    std::string events;         ///< a sentence: whose fixations, saccades and blinks these are
    bool is_complete = false;
    int trials = 0; ///< that count, before exclusions of this analysis
    SessionSetup setup;
    bool is_simulated() const { return setup.gaze.is_simulated(); }
};

/// An observer of the sessions that were given, and whether N has them. One counts whose gaze there is in a
/// trial that counts and is not excluded.
struct StudyObserver {
    std::string label;
    bool counts = false;
    std::string why; ///< a clause, such as "no gaze was recorded in any trial"; empty if counted
    std::vector<std::string> alike; ///< labels of others that differ in case or leading zeros only
    int sessions = 0, trials = 0, fixations = 0; ///< trials not excluded; counted fixations
};

/// What an article has to report: see reporting.h.
struct ReportingItem {
    std::string topic, item, value;
    bool is_recorded = false; ///< else the value says what to add
};

/// Whole sentences on one topic of the methods: see methods_text.h.
struct MethodsParagraph {
    std::string topic, text;
};

/// A place of an object that the protocol's [[points]] name.
struct NamedPlace {
    std::string name;         ///< "ID.1"
    glm::dvec3 position{0.0}; ///< in the mesh's unit
};

/// An object with all sessions that showed the same mesh.
struct StudyObject {
    std::string id, title;
    /// Null where the sessions have no mesh, such as imported ones: no maps then, and `remark` says why.
    std::shared_ptr<const Mesh> mesh;
    std::vector<std::string> part_names;
    Areas areas; ///< of its surface
    Camera camera;
    glm::dvec3 axis_point{0.0}; ///< in the mesh's unit; the object turns about the vertical through it
    ScreenGeometry screen;
    std::string unit = "mm"; ///< of the mesh, as RecordedObject has it: "mm" if it is that
    glm::dvec3 origin{0.0};  ///< in the mesh's unit, as RecordedObject has it
    // As ObjectScale has them; nothing without a known camera.
    std::optional<double> mm_per_unit, mm_per_deg, shown_size;
    /// By vertex of the mesh: how long one presentation shows it, in seconds; 0: never visible.
    std::vector<float> seconds_visible;
    /// By vertex: density that gaze would have that is spread evenly over the object's picture all the
    /// time, per mm^2; its integral over the surface is 1.
    std::vector<float> exposure_density;
    std::vector<NamedPlace> points = {};
    std::string remark;
};

/// Why a fixation, or a trial, is not counted.
enum class NotCounted : std::uint8_t {
    counted,            ///< it is
    began_before_onset, ///< under way when the presentation began
    too_short,          ///< shorter than the least duration of the options
    no_frame_lit,       ///< no frame was lit during it
    not_on_surface,     ///< too small a share of its samples met the object
    no_surface,         ///< the session has no maps of this object
    trial_excluded,     ///< its trial is
    no_stimulus,        ///< the session knows of no stimulus: an imported recording
};

/// What a trial is excluded for, in the order in which it is asked (ExclusionRules).
enum class ExclusionRule : std::uint8_t { lost_share, accuracy, drift, missed_refreshes };

/// How probable a fixation's measured place is, per square pixel, if an area was looked at, and if something
/// else of the object was: the tracker's error lies between the two (area_evidence.h). Both 0: it tells
/// nothing.
struct AreaEvidence {
    double inside = 0.0, elsewhere = 0.0;
    bool tells() const { return inside + elsewhere > 0.0; }
};

/// Lightness at a fixation's samples (LightScores), means.
struct FixationLight {
    double met = 0.0;      ///< of what gaze met
    double at_place = 0.0; ///< at the fixation's mean place on the screen, over the whole animation
    double at_point = 0.0; ///< of its point of the surface while it is visible, by how large it is seen
};

/// A fixation, re-projected sample by sample through the frames lit meanwhile.
struct StudyFixation {
    int trial = 0;           ///< index into StudyResults::trials
    double onset_s = 0.0;    ///< since the presentation's onset
    double duration_s = 0.0; ///< as its events have it, cut at the presentation's end
    ScreenPoint place;       ///< mean of its samples, on the screen
    NotCounted why = NotCounted::counted;
    int samples = 0;                       ///< with gaze, while a frame was lit
    double on_surface = 0.0;               ///< share of these that met the object
    double within_reach = 0.0;             ///< share that missed it by no more than the reach
    bool only_by_reach = false;            ///< counted, and would not be without the reach
    int first_frame = -1, last_frame = -1; ///< of the animation; -1: none
    double mid_angle_deg = 0.0;            ///< of the object, halfway through
    PoseIndex mid_pose;                    ///< of its session, lit halfway through if samples > 0
    ScreenPoint mid_gaze;                  ///< then
    /// By area of the object (StudyObject::areas); empty if the tracker's error is not known.
    std::vector<AreaEvidence> evidence;
    // Where it met the surface; meaningful if triangle is set.
    std::optional<std::uint32_t> triangle; ///< of the point: nothing if no sample met a mesh
    glm::dvec3 barycentric{0.0};
    glm::dvec3 position{0.0}; ///< object coordinates, in the mesh's unit: of the sample nearest to all others
    std::optional<PartIndex> part;      ///< the part with most samples
    double sigma_mm = 0.0;              ///< of the map's kernel at this depth
    double mm_per_deg = 0.0;            ///< of visual angle at this depth; 0 without a known camera
    std::optional<double> spread_mm;    ///< root mean square distance of its samples from the point
    std::optional<double> spread_deg;   ///< the same, seen by the observer
    std::optional<double> cone_at_edge; ///< share of the tracker's gaze cone on another sheet, or beside
    /// Root mean square distance of the rest of the cone from its middle: the tracker's error along the
    /// surface, however obliquely that is seen.
    std::optional<double> cone_mm;
    /// Of its samples, in deg^2: means of the products of gaze's and its surface point's ways on the screen
    /// from their means, and of the squares of the point's; both 0 where it is not known.
    double gaze_with_surface_deg2 = 0.0, surface_way_deg2 = 0.0;
    /// The same means of points about the fixation's, as far from it as the tracker's error puts it from what
    /// was looked at: for gains without that error (gaze_motion.h). Nothing if the error is not known.
    struct DisplacedMotion {
        double gaze_with_surface_deg2 = 0.0, surface_way_deg2 = 0.0;
    };
    std::optional<DisplacedMotion> displaced_motion{};
    double surface_deg_s = 0.0;         ///< mean speed of the surface point on the screen
    std::optional<FixationLight> light; ///< nothing without pictures of the stimulus's light
    std::optional<double> lut_mm;       ///< distance of the point that the map gave from the line of sight
    bool counted() const { return why == NotCounted::counted; }
};

/// Samples a second of a trace: enough to see a saccade.
inline constexpr double most_trace_hz = 125.0;

/// One gaze sample of a trace.
struct StudyTracePoint {
    double time_s = 0.0;             ///< since the presentation's onset
    std::optional<ScreenPoint> gaze; ///< nothing: the eye was lost
    float pupil = 0.0f;              ///< the tracker's own unit
};

struct StudyTraceEvent {
    GazeEvent::Kind kind = GazeEvent::Kind::fixation; ///< fixation, saccade or blink
    double onset_s = 0.0, duration_s = 0.0;
    std::optional<double> amplitude_deg{}, peak_velocity_deg_s{}; ///< of a saccade, where its event has them
};

/// Gaze of a trial, thinned to at most `most_trace_hz`.
struct StudyTrace {
    int trial = 0; ///< index into StudyResults::trials
    std::vector<StudyTracePoint> points;
    std::vector<StudyTraceEvent> events;
};

/// When the object came to stand at another angle.
struct StudyTurn {
    double time_s = 0.0; ///< since the presentation's onset
    double angle_deg = 0.0;
    int frame = 0;
};

/// Data quality, of a trial or altogether, as the field's minimum reporting guideline asks (Dunn et al.
/// 2023).
struct StudyQuality {
    std::optional<double> accuracy_deg;       ///< mean offset of the validation that was valid then
    std::optional<double> worst_accuracy_deg; ///< its largest
    std::optional<double> drift_deg;          ///< gaze error at the drift check
    std::optional<double> rms_s2s_deg;        ///< of successive samples within fixations, median over these
    std::optional<double> sd_deg;  ///< of samples around the eye's motion within fixations, median over these
    std::optional<double> rate_hz; ///< from the samples' own time stamps
    double samples = 0.0, lost = 0.0; ///< numbers of samples; lost ones outside of blinks
    double lost_in_blinks = 0.0;
    int blinks = 0;
    int refreshes = 0;
    std::optional<int> missed_refreshes = 0; ///< nothing where timing is unproven, or that of a part is
    double off_plan = 0.0; ///< samples that the planned times would have put on another frame
    double lost_share() const { return samples > 0.0 ? lost / samples : 0.0; }
    double blink_share() const { return samples > 0.0 ? lost_in_blinks / samples : 0.0; }
};

/// A trial that came to its end.
struct StudyTrial {
    int session = 0;            ///< index into StudyResults::sessions
    int object = 0;             ///< index into StudyResults::objects
    std::string label;          ///< "observer 07, trial 3"
    int number = 0;             ///< in the observer's order, from 1
    std::vector<StudyKey> keys; ///< all columns of the table of trials, and the form's fields
    double presentation_s = 0.0;
    bool excluded = false;
    std::string why_excluded;                      ///< whole sentence
    std::size_t first_fixation = 0, fixations = 0; ///< range of StudyResults::fixations
    std::vector<StudyTurn> turns;
    double clock_uncertainty_s = 0.0; ///< bound on the error of its samples' times by the session's clock
    StudyQuality quality;
    bool has_gaze = true; ///< any, or a fixation that the tracker told; a trial without it is excluded
    /// The value in a column; n/a if there is no such column.
    const std::string& key(const std::string& column) const;
};

/// How a map weighs fixations.
enum class MapWeighting : std::uint8_t { duration, count };

/// Trials that have the same values in the columns of `--by`.
struct StudyGroup {
    std::vector<StudyKey> keys; ///< in the order of the list
    std::vector<int> trials;    ///< indices, without the excluded
    int observers = 0;
    int fixations = 0; ///< counted ones
};

/// How well the places of a map's fixations are known: root mean squares over the fixations, weighted as the
/// map weighs them, in millimetres on the surface. The kernel is no error: it stands beside these in the map.
struct ErrorBudget {
    std::optional<double> accuracy_mm;  ///< of the tracker, by the validation before each trial
    std::optional<double> precision_mm; ///< of a single sample, by RMS-S2S
    std::optional<double> lut_mm;       ///< of the look-up of surface points
    std::optional<double> timing_mm;    ///< uncertainty of the clocks times the speed of the surface there
    std::optional<double> together_mm;  ///< root of the sum of these squares; nothing without the accuracy
    std::optional<double> at_edge;      ///< mean share of the gaze cone beside the object or on another sheet
    std::optional<double> near_edge;    ///< share of samples with any of their gaze cone there
};

/// The map of one group on one object.
struct StudyMap {
    int group = 0;
    int object = 0;
    MapWeighting weighting = MapWeighting::duration;
    /// By vertex, the mean over trials: by duration in ms of fixation per mm^2, by count in fixations per
    /// mm^2. Empty if there is none, and `absent` says why.
    std::vector<float> density;
    std::string absent;
    double total = 0.0; ///< integral over the surface: ms, or fixations, of a trial
    double peak = 0.0;  ///< highest density
    double mean = 0.0;  ///< total divided by the surface's area
    double area_mm2 = 0.0;
    int observers = 0, trials = 0, fixations = 0;
    double least_sigma_mm = 0.0, most_sigma_mm = 0.0; ///< of the kernel, over the fixations
    /// Share of the weight that a Gaussian in space of the same sigma puts beyond three sigmas along the
    /// surface; EuclideanKernel::share_on_a_plane of it is no leak.
    std::optional<double> euclidean_leak;
    ErrorBudget error;
};

/// What a group's gaze does with an area: of fixations on objects that have it. Figure 4 are the shares of
/// one area. Of the other measures see area_looks.h.
struct AreaRow {
    std::string area;
    std::vector<StudyKey> keys;     ///< a group's, or a single one of these: all trials with it; empty: all
    Estimate by_count, by_duration; ///< means over observers of their own fractions, with intervals over them
    /// The same with the tracker's error taken out: most probable given where all fixations were measured.
    Estimate corrected;
    std::optional<double> pooled;            ///< all fixations together, as the paper has it
    std::optional<Interval> pooled_interval; ///< Wilson's, as if fixations were independent
    std::optional<double> planted; ///< of simulated observers: the fraction that they mean to look at
    std::optional<double> drawn{}; ///< of these: what chance made of it in these very trials
    int observers = 0, trials = 0, fixations = 0;
    std::vector<double> of_observers{}; ///< their own fractions by count, those who have any
    // What shares there would be if gaze were spread evenly over the surface, and over what is seen of it:
    // means over the fixations' objects. Nothing where the surface is not known.
    std::optional<double> share_of_surface{}, share_of_exposure{};
    Estimate over_surface{}, over_exposure{}; ///< by_count as a multiple of these
    // Of trials: means over each observer's, then over observers.
    Estimate dwell_s{};              ///< time of fixation on the area, of a trial
    Estimate visits{};               ///< of a trial
    Estimate visit_s{};              ///< time of fixation of a visit
    Estimate reached{};              ///< share of trials in which it was fixated at all
    Estimate first_arrival_s{};      ///< since onset; a trial without counts with its whole presentation
    Estimate first_arrival_number{}; ///< of the fixation, from 1, in trials in which it was reached
    int looks = 0;                   ///< trials whose object has the area
    int arrivals = 0;                ///< of these, in which it was reached
};

/// How gaze goes from one area to another, or stays: see surface_transitions.h.
struct SurfaceTransitionRow {
    std::vector<StudyKey> keys; ///< a level of a column; empty: all
    std::string from, to;
    Estimate probability; ///< of the next fixation being on `to`, after one on `from`
    Estimate chance;      ///< share of `to` among all next fixations
    Estimate over_chance; ///< difference of the two
    int observers = 0, transitions = 0, departures = 0;
};

/// Two levels of a factor compared within observers by their shares of fixations on an area.
struct AreaPairRow {
    std::string area;
    std::vector<StudyKey> keys; ///< as in PairRow
    std::string column, a, b;
    Estimate difference; ///< share of fixations on the area, of a less that of b
    /// Sign flips over observers; after Holm over the rows of the area, those over all groups apart; and over
    /// the areas, too.
    std::optional<double> p, p_holm, p_holm_areas;
    PairedEvidence evidence{};          ///< of the difference
    int observers = 0, comparisons = 0; ///< of an observer with one object
};

/// Figure 5: the distribution of a group's fixations on one object.
struct DistributionRow {
    int group = 0, object = 0;
    Estimate wss_mm2, wss_deg2;            ///< sum of the variances, 1 / N
    std::optional<double> planted_wss_mm2; ///< of simulated observers: of what they mean to look at
    std::array<std::optional<double>, 3> variance_mm2, variance_deg2; ///< of x, y, z
    std::optional<double> map_peak, map_mean; ///< of the map by duration, ms / mm^2 and trial
    int observers = 0, fixations = 0;
};

/// A similarity of two maps beside what to compare it with.
struct SimilarityEstimate {
    Estimate value;
    /// Of maps of two different observers, all of as many fixations of either level: who saw different
    /// levels, who saw the same one, and the latter less the former, 0 where levels make no difference.
    Estimate other_level, same_level, level_effect;
    Estimate null;           ///< of whole trials, dealt out again over the levels within observers
    std::optional<double> p; ///< how often that gives as small a similarity
};

/// Table 1: two levels of a factor compared within observers, then averaged.
struct PairRow {
    std::vector<StudyKey> keys; ///< what is the same in both: task; empty: all groups, compared within each
    std::string column, a, b;   ///< "material", "rough", "smooth"
    Estimate wss_difference_mm2, wss_difference_deg2;
    // Sign flips over observers. Holm's correction is over the rows of groups, or over those of all groups.
    std::optional<double> wss_p, wss_p_holm;
    PairedEvidence wss_evidence{};             ///< of the difference in deg2
    std::optional<double> maps_cc;             ///< of the maps of all observers, mean over objects and groups
    std::optional<double> maps_p, maps_p_holm; ///< swaps of the levels within observers (swap_test)
    SimilarityEstimate cc, sim_mit, sim_pysaliency;
    int observers = 0, comparisons = 0; ///< of an observer with one object
    std::string absent;                 ///< why there is nothing
};

/// Where two levels differ on one object, within observers.
struct DifferenceMap {
    std::vector<StudyKey> keys; ///< what is the same in both; empty: anything
    int object = 0;
    std::string column, a, b;
    /// By vertex: mean over observers of a less b, of maps that hold each observer's share of the time of
    /// fixation per mm^2. Empty if there is none, and `absent` says why.
    std::vector<float> difference;
    std::vector<std::uint16_t> cluster; ///< by vertex: number of the cluster that it is in, from 1; 0: none
    struct Cluster {
        double mass = 0.0; ///< sum of t * area, mm^2
        double area_mm2 = 0.0;
        glm::dvec3 centroid_mm{0.0};   ///< of the size of the difference; object coordinates
        std::optional<PartIndex> part; ///< with most of it
        double difference = 0.0; ///< integral: share of the time of fixation that a has there more than b
        double p = 1.0;          ///< corrected over the surface
        double p_of_all = 1.0;   ///< and over all maps of differences of the table
        std::optional<double> free_p = {}; ///< without a threshold: the least of its vertices
    };
    std::vector<Cluster> clusters; ///< largest first
    double threshold_t = 0.0;
    double least_p = 1.0; ///< that so many observers can give
    /// Without a threshold, where that is asked for: the least p on the surface, and the area of where p is
    /// no more than 1 less the level of intervals.
    std::optional<double> free_least_p = {}, free_area_mm2 = {};
    int observers = 0;
    std::string absent;
};

/// What a map of fixations is told from.
enum class MapPredictor : std::uint8_t {
    same_level,  ///< the other observers' fixations in the same group
    other_level, ///< the other observers' fixations in another level of the compared column
    exposure,    ///< how long, how large and how obliquely each place could be seen
    model        ///< a map that was given
};

/// How well a group's fixations on one object are told by a map that none of them made: means over
/// observers of what each one's fixations give. Only places that could be seen count.
struct MapPredictionRow {
    int group = 0, object = 0;
    MapPredictor by = MapPredictor::same_level;
    std::string
        level;    ///< of the compared column, of the predicting map; of a model its name; empty: exposure
    Estimate kl;  ///< nats, of the observer's map from the predicting one
    Estimate nss; ///< standard deviations
    Estimate auc_judd, auc_borji;
    Estimate gain_over_exposure; ///< bits per fixation; of the exposure absent
    Estimate gain_over_area;     ///< the same over gaze that is spread evenly over all that could be seen
    /// gain_over_area as a share of that of the other observers' map, same_level: the ceiling of all
    /// predictions.
    Estimate share_of_ceiling{};
    int observers = 0, fixations = 0;
};

/// How well a map would come out again with other observers.
struct MapReliabilityRow {
    std::vector<StudyKey> keys; ///< a group's, or a single one of these: all trials with it; empty: all
    int object = 0;
    Estimate split_half_cc; ///< of the maps of two halves of the observers, as the reliability has it
    Estimate reliability;   ///< of the map of all observers together (map_agreement.h)
    int observers = 0, fixations = 0;
};

/// Whether a factor, or two of them together, have an effect on trials: see factor_effects.h.
struct FactorEffectRow {
    std::string measure; ///< "share on AREA", "log WSS"
    std::string effect;  ///< a column, or two with a colon between: their interaction
    std::optional<double> statistic, p, p_holm;
    std::optional<double> least_p; ///< that so many observers can give
    int observers = 0;
    std::string absent;
};

/// Whether gaze goes with the surface or stays on the screen while a fixation lasts: see gaze_motion.h.
struct GazeMotionRow {
    std::vector<StudyKey> keys;   ///< a level of a column; empty: all
    Estimate surface_gain;        ///< 1: gaze goes with the surface; 0: it stays on the screen
    Estimate corrected_gain;      ///< the same without what the tracker's error makes of it
    Estimate surface_speed_deg_s; ///< of the surface under these fixations, mean
    int observers = 0, fixations = 0;
};

/// Whether fixations are drawn by light: see light_at_gaze.h.
struct LightAtGazeRow {
    std::vector<StudyKey> keys; ///< a level of a column; empty: all
    Estimate lightness;         ///< of what gaze met, in standard deviations of the object's
    Estimate over_place;        ///< more than the same place of the screen has over the animation
    Estimate over_point;        ///< more than the same point of the surface has while it is visible
    int observers = 0, fixations = 0;
};

/// What a presentation shows of an area of an object.
struct ExposureRow {
    int object = 0;
    std::string area; ///< empty: the whole object
    double area_mm2 = 0.0;
    double share_of_area = 0.0;
    double never_visible = 0.0;     ///< share of its area
    double seconds_visible = 0.0;   ///< mean over its area
    double share_of_exposure = 0.0; ///< of the time and solid angle that the object fills in the picture
    std::optional<double> foreshortening;     ///< mean cosine of sight line and normal while it is visible
    std::optional<double> share_of_fixations; ///< of all that are counted on the object
};

/// Share of fixations on an area in a stretch of the presentation.
struct TimeCourseRow {
    std::string area;
    StudyKey key; ///< one level of the first column of `--by`
    double from_s = 0.0, to_s = 0.0;
    Estimate share; ///< by duration within the stretch, over observers
    int observers = 0;
};

struct StudyGlance {
    std::string title; ///< of the protocol, or of several
    int observers = 0; ///< N: those who count, see StudyObserver
    int sessions = 0, trials = 0, excluded_trials = 0;
    std::int64_t samples = 0;
    int fixations = 0; ///< all
    int counted = 0;
    int only_by_reach = 0;                               ///< of these: see StudyFixation
    std::vector<std::pair<NotCounted, int>> not_counted; ///< reasons that occur, and how often
    double counted_s = 0.0;                              ///< of fixation
    bool any_simulated = false;
    int without_gaze = 0;                                     ///< excluded trials in which none was recorded
    std::vector<std::pair<ExclusionRule, int>> excluded_by{}; ///< others, by the first rule that they break
};

/// What the report says first: whole sentences.
struct StudyHeadline {
    std::string question; ///< what observers were asked
    std::string design;   ///< what differed, and how often each was shown
    std::string sample;   ///< N, and who and what was left out
    std::string result;   ///< the main one, with its interval
    /// What the result is of, by which the report is in order: "curves", "matches", "scales", "trends",
    /// "likenesses", "reliefs", "points", "ratings", "choices", "areas"; empty: there is no result.
    std::string measure = {};
};

struct StudyResults {
    StudyGlance glance;
    StudyHeadline headline;
    std::vector<StudyParameter> parameters;
    /// What a reader must know, whole sentences: sessions of different protocols, missing maps, one observer.
    std::vector<std::string> remarks;
    std::vector<std::string> by; ///< columns that make the groups
    double confidence = 0.95;
    std::vector<StudySession> sessions;
    std::vector<StudyObserver> observers; ///< in the order of the sessions
    std::vector<StudyObject> objects;
    std::vector<StudyTrial> trials;
    std::vector<StudyFixation> fixations; ///< by trial, in the order of their onsets
    std::vector<StudyGroup> groups;
    std::vector<StudyMap> maps;     ///< by group, object and weighting
    std::vector<std::string> areas; ///< of all objects, each once
    std::string area;               ///< that of figure 4, the first of those that are compared; empty: none
    std::vector<std::string> compared_areas; ///< those that tests are corrected over
    std::vector<AreaRow> area_rows;          ///< by area, in their order
    std::vector<SurfaceTransitionRow> surface_transitions;
    std::vector<AreaPairRow> area_pairs;
    std::vector<DistributionRow> distributions;
    std::vector<PairRow> pairs;
    std::vector<DifferenceMap> differences;
    /// Where observers looked before one answer less before another: `column` is the answer's id, `a` and `b`
    /// what was answered, or, among slots, "chosen" and "not chosen".
    std::vector<DifferenceMap> answer_maps;
    std::vector<MapPredictionRow> predictions;
    std::vector<MapReliabilityRow> reliabilities;
    std::vector<ExposureRow> exposures;
    std::vector<TemplateFitRow> template_fits; ///< by object; empty: each object is its own
    std::vector<FactorEffectRow> effects;
    std::vector<GazeMotionRow> motions;
    std::vector<LightAtGazeRow> lights;
    std::vector<TimeCourseRow> time_course;
    std::vector<TimeClusterRow> time_clusters;
    std::vector<FirstFixationsRow> first_fixations;
    std::vector<MeasureDifferenceRow> measure_differences;
    std::vector<ScanpathRow> scanpaths;
    std::vector<ScanpathLikenessRow> scanpath_likeness;
    std::vector<std::vector<ScreenArea>> screen_areas; ///< by trial; empty: no trial has any
    std::vector<ScreenAreaTrialRow> screen_area_trials;
    std::vector<AreaTransitionRow> area_transitions;
    std::vector<ScreenAreaRow> screen_area_groups;
    StudyAnswers answers;                      ///< of [[task.answer]]
    StudyReliefs reliefs;                      ///< of gauges
    StudyExplorations explorations;            ///< of objects that observers turned
    StudyPoints points;                        ///< that were answers
    std::vector<StudyQuality> session_quality; ///< by session
    std::vector<ReportingItem> reporting;
    std::vector<MethodsParagraph> methods;
    std::vector<StudyTrace> traces; ///< of each trial with samples, in the order of the trials
};

/// Whether any session knows what it showed, which recordings of other programs do not.
bool knows_stimuli(const StudyResults& results);

/// Samples a second below which short saccades between near places, such as two on a head, are often missed,
/// so that the fixations beside them run together: of planted events 98 % are found from 120 Hz on, 78 % at
/// 60 Hz (docs/events.md). Trackers give a little less than they say.
inline constexpr double least_rate_for_counts_hz = 115.0;

/// The least rate of sessions with gaze, if it is too low for fixations to be counted. Shares by duration
/// suffer less.
std::optional<double> rate_too_low_for_counts(const StudyResults& results);

/// A few words for tables and sentences.
std::string_view name_of(NotCounted why);
std::string_view name_of(MapWeighting weighting);
std::string_view name_of(MapPredictor predictor);

} // namespace overt
