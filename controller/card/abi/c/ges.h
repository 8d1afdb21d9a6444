/* The library of the GE motion card, as drycut has it; see docs/libges.md. */
#ifndef DRYCUT_GES_H
#define DRYCUT_GES_H

#ifdef __cplusplus
extern "C" {
#endif

/* What a call through the look-ahead tells. */
typedef struct {
    long mtnNum;
    short num;
    short error;
} TLookAheadMsg;

/* A block for GT_AddLookDataEx; as the parameters of GT_AddLookData. */
typedef struct {
    char Code;
    char PlaneGroup;
    double r;
    double x;
    double y;
    double z;
    double F;
    double cx;
    double cy;
    short i;
    long n;
    short flag;
} TLookData;

/* Called after each command with its name and its code. */
typedef void CCommandHandle(char *name, short code);

/* Let the card's time pass, ms; the card's time, ms. No functions of the card. */
void drycut_sleep(unsigned long ms);
unsigned long drycut_milliseconds(void);
/* functions */

#ifdef __cplusplus
}
#endif

#endif
