#include "app/display/tracker_doctor.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/rig/tracker_devices.h"

namespace overt {

namespace {

constexpr std::string_view host_address = "100.1.1.1", host_net = "100.1.1.";

} // namespace

std::string eyelink_network(std::span<const NetworkCard> cards) {
    std::string others;
    const NetworkCard* free_card = nullptr;
    for (const NetworkCard& card : cards) {
        if (card.address == host_address)
            return fmt::format(
                "{} has {}, which is the address of an EyeLink's host itself: give it another, "
                "such as 100.1.1.2",
                card.name, card.address);
        if (card.address.starts_with(host_net))
            return fmt::format("{} has {}, in the net of an EyeLink's host ({}){}", card.name, card.address,
                               host_address,
                               !card.is_up      ? "; but it is switched off"
                               : !card.has_link ? "; but no cable is plugged in, or the host is switched off"
                                                : "");
        if (card.address.empty() && !free_card)
            free_card = &card;
        others += fmt::format("{}{} {}", others.empty() ? "" : ", ", card.name,
                              card.address.empty() ? "without an address" : card.address);
    }
    if (cards.empty())
        return "there is no network card";
    return fmt::format("no card is in the net of an EyeLink's host ({}): {}. For one: sudo ip address add "
                       "100.1.1.2/24 dev {}",
                       host_address, others, free_card ? free_card->name : std::string("CARD"));
}

std::vector<DoctorFinding> examine_trackers() {
    std::vector<DoctorFinding> findings;
    for (const TrackerKind kind : all_kinds<TrackerKind>)
        if (row_of(kind).is_hardware())
            findings.push_back(
                {fmt::format("eye tracker, {}", name_of(kind)),
                 fmt::format("{}; {}", tracker_found(kind), tracker_device(kind, false).can_do)});
    findings.push_back({"  network for an EyeLink", eyelink_network(network_cards())});
    findings.push_back({"  how fast one samples",
                        "`overt tracker test --tracker KIND` measures rate, loss, round "
                        "trip and drift of its clock"});
    return findings;
}

} // namespace overt
