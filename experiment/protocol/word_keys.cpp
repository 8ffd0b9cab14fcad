#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section words() {
    using W = WordSettings;
    const auto text = [](std::string_view name, std::string W::*member, std::string_view explanation) {
        return Key{{.name = name, .explanation = explanation}, member};
    };
    return {
        .name = "words",
        .explanation =
            "What the program itself says on the screen, to be written in the language of the lab. The "
            "keys it names are those of `[operator]`.",
        .keys =
            {
                text("keyboard_lost", &W::keyboard_lost,
                     "Shown between trials while another window has the keyboard."),
                text("recalibrate", &W::recalibrate, "Asked before the tracker is calibrated anew."),
                text("validation", &W::validation,
                     "Asked when the program has calibrated the tracker; mean and largest error follow."),
                text("validation_poor", &W::validation_poor,
                     "Asked when the errors are larger than `[tracker]` allows; they follow."),
                text("not_calibrated", &W::not_calibrated,
                     "Asked when a calibration was cancelled or failed."),
                text("tracker_lost", &W::tracker_lost, "Asked when the tracker has gone away."),
                text("repeat", &W::repeat, "Asked before a trial is broken off and repeated."),
                text("reject", &W::reject, "Asked before a trial is rejected."),
                text("skip", &W::skip, "Asked before a trial is skipped; the reasons follow."),
                text("abort", &W::abort, "Asked before the session is ended between trials."),
                text("abort_in_trial", &W::abort_in_trial, "Asked before it is ended in a trial."),
                text("yes", &W::yes, "Beside the key that confirms."),
                text("no", &W::no, "Beside the key that takes it back."),
                text("optional", &W::optional, "Behind a field of the form that may stay empty."),
                text("choose", &W::choose, "Below the form: what left and right do in a choice."),
                text("back", &W::back, "Below the form: what up does in the last field."),
                text("other_fields", &W::other_fields, "Below the form: what up and down do."),
                text("next", &W::next, "Below the form: what enter does."),
                text("done", &W::done, "Below the form: what enter does in the last field."),
                text("missing", &W::missing, "Below the form: a field must not stay empty."),
                text("not_possible", &W::not_possible, "Below the form: a value is out of range."),
                text("form_title", &W::form_title, "Above the form."),
                text("space_bar", &W::space_bar, "What the space bar is called."),
                text("enter_key", &W::enter_key, "What the enter key is called."),
                text("agree", &W::agree, "Below the consent: what its accept key says."),
                text("decline", &W::decline, "Below the consent: what its decline key says."),
                text("go_on", &W::go_on, "Below a text: what the space bar does."),
                text("answered", &W::answered, "Below the response screen: what the space bar says."),
                text("close", &W::close, "Below the farewell: what the space bar does."),
                text("rest", &W::rest, "Below a break while keys do nothing yet; {} stands for the seconds."),
                text("goes_on_itself", &W::goes_on_itself,
                     "Below a break that only time ends; {} stands for the seconds."),
                text("please_wait", &W::please_wait,
                     "While the tracker is calibrated by itself, and the first stimulus is loaded."),
                text("experimenter", &W::experimenter,
                     "Above pauses and questions that are not the observer's to answer."),
                text("too_loud", &W::too_loud, "Beside the level meter: the microphone clips."),
                text("no_voice", &W::no_voice, "Beside the level meter: nothing is heard."),
            },
        .home = &Protocol::words};
}

Section dataset() {
    using D = DatasetSettings;
    const auto text = [](std::string_view name, std::string D::*member, std::string_view explanation,
                         std::string_view if_left_out = "none") {
        return Key{{.name = name, .if_left_out = if_left_out, .explanation = explanation}, member};
    };
    const auto list = [](std::string_view name, std::vector<std::string> D::*member,
                         std::string_view explanation) {
        return Key{{.name = name, .if_left_out = "none", .explanation = explanation}, member};
    };
    return {
        .name = "dataset",
        .explanation =
            "What `overt export --format bids` writes into the description of a dataset. It stands in the "
            "record of each session; the first session that a dataset is made of describes it.",
        .keys =
            {
                text("name", &D::name, "Name of the dataset.", "the protocol's title"),
                list("authors", &D::authors, "Who has made it, a text for each."),
                text("license", &D::license,
                     "Under which licence it may be used, as \"CC0\" or \"CC-BY-4.0\"."),
                list("keywords", &D::keywords, "What it is about."),
                text("acknowledgements", &D::acknowledgements, "Who helped without being an author."),
                text("how_to_acknowledge", &D::how_to_acknowledge, "How who uses it is to cite it."),
                list("funding", &D::funding, "Who paid, with numbers of grants."),
                list("ethics_approvals", &D::ethics_approvals,
                     "Committees that approved of it, with numbers of protocols."),
                list("references", &D::references, "Publications and pages about it."),
                text("doi", &D::doi, "Its DOI, as \"doi:10.…\"."),
                text("institution_name", &D::institution_name, "Where it was recorded."),
                text("institution_address", &D::institution_address, "Address of that place."),
                text("department", &D::department, "Department of that place."),
            },
        .home = &Protocol::dataset};
}

} // namespace overt::key_rows
