/* gt400.h is the header of another card, and is refused by name. */
#ifndef DRYCUT_GT400_H
#define DRYCUT_GT400_H
#error "gt400.h belongs to another card than ges.h: 45 functions of one name take other parameters, 71 are there alone, and speeds are pulses per control period. libges emulates the card of ges.h only."
#endif
