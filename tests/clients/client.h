/* What the clients share: where the card is, and how they wait for it, in the ways of programs for the card. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ges.h"

enum { IDLE = 1 << 0 };
enum { CAPTURED = 1 << 3, ON_POSITIVE = 1 << 5, ON_NEGATIVE = 1 << 6, MOVING = 1 << 10 };

static unsigned short crd(void)
{
    unsigned short status = 0xDEAD;
    GT_GetCrdSts(&status);
    return status;
}

static unsigned short sts(unsigned short axis)
{
    unsigned short status = 0xDEAD;
    GT_GetSts(axis, &status);
    return status;
}

static void wait_idle(void)
{
    while (!(crd() & IDLE))
        ;
}

static void tell(const char *what)
{
    double place[4];
    GT_GetPrfPnt(place);
    printf("%s: %.0f %.0f %.0f %04x\n", what, place[0], place[1], place[2], crd());
}
