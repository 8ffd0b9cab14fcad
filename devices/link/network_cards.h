/// The network cards of this computer.
#pragma once

#include <string>
#include <vector>

namespace overt {

/// A card with one of its IPv4 addresses.
struct NetworkCard {
    std::string name;      ///< as the system has it, such as "enp3s0"
    std::string address;   ///< "100.1.1.2"; empty: it has none
    bool is_up = false;    ///< switched on
    bool has_link = false; ///< a cable is plugged in, or a radio is connected
};

/// All but the loopback; a card with several addresses is there once for each. Empty where the system does
/// not tell.
std::vector<NetworkCard> network_cards();

} // namespace overt
