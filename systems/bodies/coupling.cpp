#include "systems/bodies/coupling.hpp"

namespace cullet {

bool share_a_striker(const TaskContacts& contacts, uint32_t c, uint32_t other) {
    return c != other && contacts.striker_own_inverse_mass[c] > 0 && contacts.striker[c].exists() &&
           contacts.striker[c] == contacts.striker[other];
}

double coupling(const TaskContacts& contacts, uint32_t c, uint32_t other) {
    return double{contacts.striker_own_inverse_mass[c]} * dot(contacts.normal[c], contacts.normal[other]) +
           dot(contacts.striker_turn[c], contacts.striker_spin[other]);
}

}  // namespace cullet
