/// How much memory this process holds.
#pragma once

namespace overt {

/// What is resident, in MB (10^6 bytes); what the allocator keeps for later is given back first.
double resident_memory_mb();

} // namespace overt
