/* Seeks its home switch slowly, and leaves that acceleration behind; then it drives to its places, waits for fixed
   times and looks at nothing that it is told. */
#include <windows.h>

#include "client.h"

static void home(unsigned short axis, double to)
{
    long at = 0;
    GT_SetSynVel(20), GT_SetSynAcc(0.01);
    GT_ClrSts(axis), GT_CaptHome(axis);
    GT_LnXY(to, 0);
    while (!(sts(axis) & CAPTURED))
        ;
    GT_StpMtn();
    wait_idle();
    GT_GetCapt(axis, &at);
    GT_LnXY(at, 0);
    wait_idle();
    GT_ZeroPos(axis);
}

int main(void)
{
    GT_Open(65535), GT_Reset(), GT_LmtSns(0xF);
    home(1, -500000);
    GT_SetSynVel(50);
    GT_LnXY(30000, 0);
    Sleep(2000);
    GT_ZeroPos(1), GT_ZeroPos(2);
    GT_LnXY(30000, 20000);
    Sleep(4000);
    GT_LnXY(130000, 0);
    wait_idle();
    GT_LnXY(0, 0);
    wait_idle();
    tell("done");
    return GT_Close();
}
