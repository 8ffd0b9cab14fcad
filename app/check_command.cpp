#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/protocol_file.h"
#include "experiment/protocol/design_report.h"
#include "experiment/schedule.h"

namespace overt {

int run_check(const CheckOptions& options) {
    const Protocol protocol = read_protocol_or_report(options.protocol);
    std::vector<Observer> observers = planned_observers(protocol);
    if (!options.observer.empty()) {
        observers = {observer_labelled(options.observer)};
    } else if (!options.all_observers) {
        observers.resize(1);
    }
    DesignAssumptions assumptions;
    assumptions.answer_s = options.answer_time_s;
    const DesignReport report = make_design_report(protocol, observers, 1, assumptions);
    const std::string text = options.json ? to_json(report).dump(2) + "\n" : to_text(report);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

} // namespace overt
