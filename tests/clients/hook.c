/* Is told of each call, asks the card why one was refused, and prints what it heard. */
#include "client.h"

static int heard;

static void listen(char *name, short code)
{
    unsigned short why = 0xDEAD;
    heard++;
    if (code) {
        GT_GetCmdSts(&why);
        usleep(1000);
        printf("%s %d %04x\n", name, code, why);
    }
}

int main(void)
{
    GT_Open(65535);
    GT_HookCommand(listen);
    GT_SetSynVel(-1);
    GT_StrtList();
    GT_LnXY(10, 0);
    GT_LnXY(20, 0);
    GT_HookCommand(NULL);
    GT_EndList();
    printf("heard %d\n", heard);
    return GT_Close();
}
