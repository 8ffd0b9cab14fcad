#include "experiment/protocol/keys/protocol_keys.h"

#include "experiment/protocol/keys/key_rows.h"

namespace overt {

const KeyTable& protocol_keys() {
    using namespace key_rows;
    static const KeyTable table(
        {
            {"protocol", SectionHome::root<Protocol>(), protocol(), "What the experiment is called."},
            {"display", &Protocol::display, display(),
             "The screen in front of the observer. The defaults are those of a Cambridge Research Systems "
             "Display++ at 1.75 m."},
            {"stereo", &Protocol::stereo, stereo(),
             "Each eye has a picture of its own, from where it is: for a stereoscope, or for shutter "
             "glasses. "
             "All that is shown is shown to both eyes. Places and angles, in the protocol and in the record, "
             "are those of one eye's field; each eye's gaze is looked up in what that eye saw. See "
             "[stereo.md](stereo.md)."},
            {"tracker", &Protocol::tracker, tracker(),
             "The eye tracker, and how a simulated one differs from a perfect one."},
            {"further_tracker", &Protocol::further_trackers, further_tracker(),
             "Eye trackers that record at the same time as that of `[tracker]`, such as two that are to be "
             "compared. Each is calibrated as `[calibration]` says, after the session's own, and has a "
             "record of its own, which every command reads as a session; see [trackers.md](trackers.md). "
             "Drift checks, and whether a trial counts, are a matter of `[tracker]` alone. The keys are "
             "those of `[tracker]`."},
            {"calibration", &Protocol::calibration, calibration(),
             "How the eye tracker is calibrated and what of its validation is accepted; see "
             "[trackers.md](trackers.md)."},
            {"events", &Protocol::events, events(),
             "Fixations, saccades and blinks in the record, and by which thresholds the program tells them "
             "apart; see [events.md](events.md)."},
            {"view",
             &Protocol::views,
             view(),
             "The image and its camera; one section `[view]`, or several, `[[view]]`. +z is up; an object "
             "turns about the vertical through the middle of its bounding box.",
             {},
             "view"},
            {"light",
             &Protocol::lights,
             light(),
             "What surrounds the objects and is reflected in them; one section `[light]`, or several, "
             "`[[light]]`. See [lights.md](lights.md).",
             {},
             "light"},
            {"lamp", &Protocol::lamps, lamp(),
             "Something near the objects that shines evenly, and that `[[light]]` names. It is seen in what "
             "mirrors, but not by the eye, and hides nothing. Lengths are in the unit of the mesh; places "
             "count from the centre of the object's box, as it stands before it turns."},
            {"background",
             &Protocol::backgrounds,
             background(),
             "What the image of the stimulus, or its slot, shows where the object does not: `grey`, `colour` "
             "or `picture`, without any the grey of `[display]`, which is everywhere else on the screen. One "
             "section `[background]`, or several, `[[background]]`, which are a factor like all lists. "
             "Ready-made frames without alpha hide it.",
             {},
             "background"},
            {"bake", &Protocol::bake, bake(),
             "How stimuli are rendered that are not given as `[[frames]]`. `overt bake` does it, and keeps "
             "each frame; see [bake.md](bake.md)."},
            {"motion",
             &Protocol::motions,
             motion(),
             "How the objects turn: to and fro about the vertical, as a sine; one section `[animation]`, or "
             "several, `[[motion]]`.",
             {},
             "animation"},
            {"schedule", &Protocol::schedule, schedule(),
             "How many observers there will be, and what the order of their trials has to keep to. The "
             "limits hold within each block."},
            {"screens", &Protocol::screens, screens(),
             "What is shown between the animations, and for how long. In every text of a protocol that is "
             "shown, a first line that begins with `# ` is its title, and `<b>`, `<i>`, `<u>`, `<big>` and "
             "`<small>` emphasise what stands until `</b>` and so on; `&lt;` is a < where it would begin "
             "such a mark."},
            {"consent", &Protocol::consent, consent(),
             "A text that the observer has to agree to before anything else. Who declines ends the session: "
             "that is all that is recorded then. The record keeps who agreed, when, and the SHA-256 of the "
             "text."},
            {"instructions", &Protocol::instructions, instructions(),
             "What the observer reads after the welcome, page by page: backspace or the left arrow go back, "
             "any other key that writes, enter or the right arrow go on."},
            {"observer_field", &Protocol::observer_fields, observer_fields(),
             "Something to be known of the observer. The form is filled in with `--observer-field ID=VALUE`, "
             "or before the session in its window or in the terminal; what is asked after a block or at the "
             "end "
             "of the session, a questionnaire say, in its window then. Standard fields have all but their id "
             "by default: `age` (in years), `sex` (female, male, other), `vision` (normal, corrected to "
             "normal, impaired), `handedness` (left, right, ambidextrous)."},
            {"operator", &Protocol::operators, operators(),
             "Keys with which the operator leads a session. All but pausing ask first, and all are in the "
             "record. What is pressed during an animation is acted on after its last refresh; `abort` alone "
             "ends it. Whether a trial that was broken off and yet not skipped comes again is as for one "
             "that is rejected."},
            {"button_box", &Protocol::button_boxes, button_box(),
             "Response boxes, in sessions in real time; see [devices.md](devices.md). All presses are in the "
             "record with their uncertainty, and the time of an answer is that of the press. What one "
             "person's box says never counts as the other's."},
            {"marker_output", &Protocol::marker_outputs, marker_output(),
             "Where other devices are told of a session's events as they happen, in sessions in real time; "
             "see [devices.md](devices.md). When each marker was sent is in the record."},
            {"answers", &Protocol::answers, answers(),
             "Spoken answers: a WAV file for each trial that counts, from the end of the animation to the "
             "key that ends the answer, with the sample at the response screen's onset, the onset of the "
             "voice, clipping and silence in the record."},
            {"task",
             &Protocol::tasks,
             task(),
             "A question that observers are asked about what they see. At least one.",
             {{"answer",
               &Task::answers,
               answer(),
               "`[[task.answer]]`: something that is answered in each trial of the task that stands before "
               "it, "
               "one or several; see [answers.md](answers.md). Steps ask for it by its id. Without any, the "
               "answer is spoken.",
               {{"simulated", &TaskAnswer::truth, answer_truth(),
                 "What simulated observers answer: effects of known size, for a study to find."}}},
              {"probe", &Task::probes, probe(),
               "`[[task.probe]]`: a mark at a place of the surface, which it follows while the object turns; "
               "where "
               "the place is hidden nothing is drawn, and the record says so. Each trial has one place of "
               "each "
               "probe's list: all of them, or as many as `draw_points` says. The place is a factor, by the "
               "probe's id; see [points.md](points.md)."},
              {"trials", &Task::trials, trials(),
               "A rule that makes the task's trials of the levels of factors. `overt check` says how many it "
               "gives."},
              {"catch", &Task::catch_trials, catch_trials(),
               "Trials that check whether the observer attends, mixed in by chance among the task's in each "
               "block. The record and all tables mark them."}}},
            {"procedure", &Protocol::procedures, procedure(),
             "What chooses the level of a trial when it comes, from the answers so far. A task names it in "
             "its "
             "`trials`. What is chosen, and where the procedure stands, is in the record with each trial; "
             "a session that is resumed or replayed has the same levels."},
            {"block",
             &Protocol::blocks,
             block(),
             "A part of the session with an order of its own, and, with `draw`, a list of its own: phases "
             "such "
             "as study and test are blocks. Without any block, all trials are one, in "
             "random order. The limits of `[schedule]` hold in each block that does not set them itself, but "
             "for two cases, in which they would contradict what the block says: a sequential order has only "
             "limits of its own, and one blocked by a factor has none from there on this factor (by "
             "stimulus: none on stimulus, object and material).",
             {{"draw", &BlockSettings::draw, draw(),
               "A list of entries drawn for the block, such as the objects that an observer learns."},
              {"criterion", &BlockSettings::criterion, criterion(),
               "The block is over as soon as so many of its last trials were answered correctly; what is "
               "left of "
               "it does not come. Trials in which nothing is correct are not counted, and a missed answer is "
               "not correct. For practice until it is understood."}}},
            {"group", &Protocol::groups, group(),
             "A group of observers, for what differs between observers. Observers are assigned by their "
             "number: in turn, first to the first group, a group that is full being passed over. Squares and "
             "rotations go round within each group. Without any group, all observers see the same."},
            {"practice", &Protocol::practice, practice(),
             "A trial before the trials that count, to learn the task by. They come in the order of the "
             "file. Of a practice trial the session notes that it was, and what was answered; no flips, no "
             "samples."},
            {"breaks", &Protocol::breaks, breaks(),
             "Rests between trials; never before the first or after the last."},
            {"repeat", &Protocol::repeat, repeat(),
             "What becomes of a trial that failed: it comes again now, or at the end of its block, or never. "
             "An attempt that is repeated stays in the record as aborted, beside the one that counts. Limits "
             "on the order do not look at repeated trials."},
            {"simulated_observers", &Protocol::simulated_observers, simulated_observers(),
             "How simulated observers differ from one another, as people do."},
            {"simulated_effect", &Protocol::simulated_effects, simulated_effect(),
             "What the gaze of simulated observers depends on besides the task: effects of known size for a "
             "study to find. Each holds in the trials with its task, object and material; several can "
             "hold in one trial."},
            {"object",
             &Protocol::objects,
             object(),
             "A thing to look at: one of the objects that overt makes itself (`shipped`), or one of yours "
             "(`mesh`, a flat `picture`, or ready-made maps, `lut`). At least one.",
             {{"areas", SectionHome::by_name(&ObjectSettings::areas, &AreaSettings::name), area(),
               "Named areas of the object, any number of them: the measures of gaze are given for each. An "
               "area "
               "is what lies in any of its spheres, boxes and groups, and in front of all of its planes. "
               "Areas "
               "may lie in one another or overlap. Coordinates are those of the mesh file; with `lut`, those "
               "of "
               "the maps."},
              {"head", SectionHome::one_by_name(&ObjectSettings::areas, &AreaSettings::name), area(),
               "The same as `areas = { head = { … } }`."}}},
            {"material", &Protocol::materials, material(),
             "What every object is made of in turn. At least one, but for a protocol of pictures."},
            {"points", &Protocol::point_lists, points(),
             "A list of places on the surface of objects, for probes and as landmarks: spread evenly, or "
             "given "
             "one by one. Lists of one id, each of another object, correspond by their numbers. They are in "
             "the record with triangle, millimetres and part; see [points.md](points.md)."},
            {"slot", &Protocol::slot_entries, slot(),
             "A place on the screen in which a stimulus is shown, or several on a circle or a grid, for "
             "tasks "
             "that show several stimuli at once. Without any, stimuli stand where `[view]` says, in the slot "
             "\"centre\". The object takes the same share of a slot as of the image of `[view]`. Columns are "
             "even, since some outputs join pixels in pairs."},
            {"frames", &Protocol::frames, frames(),
             "A ready-made animation of one object in one material, shown instead of rendering it."},
            {"words", &Protocol::words, words(),
             "What the program itself says on the screen, to be written in the language of the lab. The keys "
             "it names are those of `[operator]`."},
            {"dataset", &Protocol::dataset, dataset(),
             "What `overt export --format bids` writes into the description of a dataset. It stands in the "
             "record of each session; the first session that a dataset is made of describes it."},
        },
        "include");
    return table;
}

} // namespace overt
