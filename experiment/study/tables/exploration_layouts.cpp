#include "experiment/study/tables/exploration_layouts.h"

#include <algorithm>

#include "experiment/study/tables/study_layout.h"

namespace overt {

RowLayout<ExplorationRow> exploration_shows_layout(const StudyResults& results) {
    using Row = ExplorationRow;
    StudyLayout<Row> to("exploration_shows",
                        "Each show of an object that the observer turned, in trials that give results.");
    to.text("observer", "Label of the observer", &Row::observer);
    to.text("session", "Folder of the session", [&results](const Row& row) {
        return results.sessions[static_cast<std::size_t>(row.session)].folder;
    });
    to.count("trial", "Position of the trial in the observer's order, from 1", &Row::trial);
    to.count("step", "Which of the trial's steps, from 1; 0: the only one that shows anything", &Row::step);
    // The same columns for all sessions, in the order in which they first come.
    std::vector<std::string> columns;
    for (const Row& row : results.explorations.shows)
        for (const auto& [column, level] : row.levels)
            if (std::ranges::find(columns, column) == columns.end())
                columns.push_back(column);
    for (const std::string& name : columns)
        to.text(name, "Level of " + name, [name](const Row& row) {
            const auto found =
                std::ranges::find(row.levels, name, &std::pair<std::string, std::string>::first);
            return found == row.levels.end() ? std::string() : found->second;
        });
    to.number("shown_s", "How long it was shown", "s", &Row::seconds);
    to.number("turning_s", "How long of that it turned: time between refreshes whose poses differ", "s",
              &Row::turning_s);
    to.number("path_deg", "Sum of the angles between poses that follow one another", "deg", &Row::path_deg);
    to.number("net_deg", "Sum of all turns about the vertical, counter-clockwise ones positive", "deg",
              &Row::net_deg);
    to.count("reversals", "Turns about the vertical against the direction of the one before",
             &Row::reversals);
    to.count("poses", "Poses that were seen", &Row::poses);
    return to;
}

RowLayout<ExplorationSummaryRow> explorations_layout() {
    using Row = ExplorationSummaryRow;
    StudyLayout<Row> to("explorations",
                        "How objects were turned, by observer and level: means over shows; of all observers, "
                        "means over their own.");
    to.text("observer", "Label of the observer; all: all together",
            [](const Row& row) { return row.observer.empty() ? std::string("all") : row.observer; });
    to.text("column", "Of which column the level is; n/a: all shows", &Row::column);
    to.text("level", "The level", &Row::level);
    to.count("observers", "Observers", &Row::observers);
    to.count("shows", "Shows", &Row::shows);
    to.estimate("path_deg", "Sum of the angles between poses that follow one another, in a show", "deg",
                &Row::path_deg);
    to.estimate("turned_share", "Share of the time of a show in which the object turned", "",
                &Row::turned_share);
    to.estimate("speed_deg_s", "Path over the time of turning", "deg/s", &Row::speed_deg_s);
    to.estimate("reversals", "Turns about the vertical against the direction of the one before, in a show",
                "", &Row::reversals);
    to.estimate("poses", "Poses that were seen in a show", "", &Row::poses);
    return to;
}

} // namespace overt
