#include "app/record/recorded_order.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/record/recorded_protocol.h"
#include "experiment/base/error.h"
#include "experiment/design/schedule.h"

namespace overt {

namespace {

/// The names that a trial's indices stand for: the task, and the entries of lists with several, always object
/// and material.
std::vector<std::pair<std::string, std::string>> words_of(const Trial& trial, const SessionHeader& header) {
    std::vector<std::pair<std::string, std::string>> words{
        {"task", header.tasks.at(static_cast<std::size_t>(trial.task)).id}};
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::vector<ListEntry> entries = entries_of(header, list);
        if (entries.size() > 1 || stimulus_lists[list].is_always_named)
            words.emplace_back(
                stimulus_lists[list].name,
                entries.at(static_cast<std::size_t>(trial.stimulus.*stimulus_lists[list].index)).id);
    }
    return words;
}

/// Empty without blocks.
std::string block_of(const Trial& trial, const SessionHeader& header) {
    return header.blocks.empty() ? "" : header.blocks.at(static_cast<std::size_t>(trial.block));
}

} // namespace

RecordedOrder recorded_order(const SessionHeader& header) {
    RecordedOrder order{header.schedule.trials, {}, {}};
    Diagnostics diagnostics;
    const std::optional<Protocol> protocol = recorded_protocol(header, diagnostics);
    if (!protocol) {
        order.why_not =
            "this version of the program cannot use the recorded protocol:\n" + diagnostics.print();
        return order;
    }
    try {
        for (const RotationRule rule : {RotationRule::together, RotationRule::crossed}) {
            order.again =
                make_schedule(*protocol, header.schedule.observer, header.schedule.seed, rule).trials;
            // A session may have been cut short on purpose: its order is the beginning.
            if (order.again.size() > order.recorded.size())
                order.again.resize(order.recorded.size());
            if (order.is_same())
                break;
        }
    } catch (const InputError& error) {
        order.why_not = error.what();
    }
    return order;
}

std::string to_text(const RecordedOrder& order, const SessionHeader& header) {
    std::string text;
    for (const Trial& trial : order.recorded) {
        const std::string block = block_of(trial, header);
        std::string line = fmt::format("{:>5} ", trial.index + 1);
        for (const auto& [name, word] : words_of(trial, header))
            line += fmt::format(" {:<12}", word);
        line += block.empty() ? "" : fmt::format(" block {}", block);
        line.erase(line.find_last_not_of(' ') + 1);
        for (const auto& [stimulus, slot] : trial.beside)
            line += fmt::format("; {}: {} {}", header.slots.at(static_cast<std::size_t>(slot)).id,
                                header.objects.at(static_cast<std::size_t>(stimulus.object)).id,
                                header.materials.at(static_cast<std::size_t>(stimulus.material)).id);
        text += line + "\n";
    }
    text += "\n";
    if (order.is_same())
        return text + fmt::format("made again from the recorded protocol and seed {}: the same\n",
                                  header.schedule.seed);
    if (!order.why_not.empty())
        return text + "cannot be made again: " + order.why_not + "\n";
    return text + fmt::format("made again from the recorded protocol and seed {}: another order\n",
                              header.schedule.seed);
}

nlohmann::ordered_json to_json(const RecordedOrder& order, const SessionHeader& header) {
    auto trials = nlohmann::ordered_json::array();
    for (const Trial& trial : order.recorded) {
        const std::string block = block_of(trial, header);
        nlohmann::ordered_json item{{"trial", trial.index + 1}};
        if (!block.empty())
            item["block"] = block;
        for (const auto& [name, word] : words_of(trial, header))
            item[name] = word;
        trials.push_back(std::move(item));
    }
    nlohmann::ordered_json json{{"seed", header.schedule.seed},
                                {"observer_number", header.schedule.observer.number},
                                {"comes_out_the_same", order.is_same()},
                                {"trials", std::move(trials)}};
    if (!order.why_not.empty())
        json["why_not"] = order.why_not;
    return json;
}

} // namespace overt
