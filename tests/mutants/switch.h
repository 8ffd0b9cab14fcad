#pragma once

extern unsigned char* overt_mutants_reached;
extern unsigned overt_mutant_on;

/// Whether change `number` of the drawn ones is on; notes that its place was reached.
inline bool overt_mutant(unsigned number) {
    overt_mutants_reached[number] = 1;
    return overt_mutant_on == number;
}
