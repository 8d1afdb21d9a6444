/* Is killed while its axes move. */
#include <signal.h>

#include "client.h"

int main(void)
{
    GT_Open(65535);
    GT_SetSynVel(1);
    GT_LnXY(100000, 0);
    for (int i = 0; i < 500; i++)
        crd();
    raise(SIGKILL);
    return 0;
}
