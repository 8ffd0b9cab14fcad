#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> words() {
    using W = WordSettings;
    return {
        {"keyboard_lost", &W::keyboard_lost,
         "Shown while another window has the keyboard, but not during a presentation."},
        {"screen_changed", &W::screen_changed,
         "Asked of the operator between trials, above what has changed of the screen."},
        {"recalibrate", &W::recalibrate, "Asked before the tracker is calibrated anew."},
        {"validation", &W::validation,
         "Asked when the program has calibrated the tracker; mean and largest error follow."},
        {"validation_poor", &W::validation_poor,
         "Asked when the errors are larger than `[tracker]` allows; they follow."},
        {"not_calibrated", &W::not_calibrated, "Asked when a calibration was cancelled or failed."},
        {"tracker_lost", &W::tracker_lost, "Asked when the tracker has gone away."},
        {"repeat", &W::repeat, "Asked before a trial is broken off and repeated."},
        {"reject", &W::reject, "Asked before a trial is rejected."},
        {"skip", &W::skip, "Asked before a trial is skipped; the reasons follow."},
        {"abort", &W::abort, "Asked before the session is ended between trials."},
        {"abort_in_trial", &W::abort_in_trial, "Asked before it is ended in a trial."},
        {"yes", &W::yes, "Beside the key that confirms."},
        {"no", &W::no, "Beside the key that takes it back."},
        {"optional", &W::optional, "Behind a field of the form that may stay empty."},
        {"choose", &W::choose, "Below the form: what left and right do in a choice."},
        {"back", &W::back, "Below the form: what up does in the last field."},
        {"other_fields", &W::other_fields, "Below the form: what up and down do."},
        {"next", &W::next, "Below the form: what enter does."},
        {"done", &W::done, "Below the form: what enter does in the last field."},
        {"missing", &W::missing, "Below the form: a field must not stay empty."},
        {"not_possible", &W::not_possible, "Below the form: a value is out of range."},
        {"form_title", &W::form_title, "Above the form."},
        {"space_bar", &W::space_bar, "What the space bar is called."},
        {"enter_key", &W::enter_key, "What the enter key is called."},
        {"agree", &W::agree, "Below the consent: what its accept key says."},
        {"decline", &W::decline, "Below the consent: what its decline key says."},
        {"go_on", &W::go_on, "Below a text: what the space bar does."},
        {"answered", &W::answered, "Below the response screen: what the space bar says."},
        {"close", &W::close, "Below the farewell: what the space bar does."},
        {"rest", &W::rest, "Below a break while keys do nothing yet; {} stands for the seconds."},
        {"goes_on_itself", &W::goes_on_itself,
         "Below a break that only time ends; {} stands for the seconds."},
        {"please_wait", &W::please_wait,
         "While the tracker is calibrated by itself, and the first stimulus is loaded."},
        {"experimenter", &W::experimenter,
         "Above pauses and questions that are not the observer's to answer."},
        {"too_loud", &W::too_loud, "Beside the level meter: the microphone clips."},
        {"no_voice", &W::no_voice, "Beside the level meter: nothing is heard."},
    };
}

std::vector<Key> dataset() {
    using D = DatasetSettings;
    return {
        {"name", &D::name, left_out("the protocol's title"), "Name of the dataset."},
        {"authors", &D::authors, left_out("none"), "Who has made it, a text for each."},
        {"license", &D::license, left_out("none"),
         "Under which licence it may be used, as \"CC0\" or \"CC-BY-4.0\"."},
        {"keywords", &D::keywords, left_out("none"), "What it is about."},
        {"acknowledgements", &D::acknowledgements, left_out("none"), "Who helped without being an author."},
        {"how_to_acknowledge", &D::how_to_acknowledge, left_out("none"), "How who uses it is to cite it."},
        {"funding", &D::funding, left_out("none"), "Who paid, with numbers of grants."},
        {"ethics_approvals", &D::ethics_approvals, left_out("none"),
         "Committees that approved of it, with numbers of protocols."},
        {"references", &D::references, left_out("none"), "Publications and pages about it."},
        {"doi", &D::doi, left_out("none"), "Its DOI, as \"doi:10.…\"."},
        {"institution_name", &D::institution_name, left_out("none"), "Where it was recorded."},
        {"institution_address", &D::institution_address, left_out("none"), "Address of that place."},
        {"department", &D::department, left_out("none"), "Department of that place."},
    };
}

} // namespace overt::key_rows
