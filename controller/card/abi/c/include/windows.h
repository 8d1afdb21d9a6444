/* What programs for the card take from windows.h, as far as it is needed without Windows. */
#ifndef DRYCUT_WINDOWS_H
#define DRYCUT_WINDOWS_H

#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif
void drycut_sleep(unsigned long ms);
unsigned long drycut_milliseconds(void);
#ifdef __cplusplus
}
#endif

typedef unsigned char BYTE;
typedef unsigned short WORD;
typedef uint32_t DWORD;
typedef unsigned int UINT;
typedef int BOOL;
typedef void *HANDLE;
typedef void *HWND;
typedef void *LPVOID;
typedef char *LPSTR;
typedef const char *LPCSTR;

#ifndef TRUE
#define TRUE 1
#endif
#ifndef FALSE
#define FALSE 0
#endif
#define INFINITE 0xFFFFFFFF
#define WINAPI
#define APIENTRY
#define CALLBACK
#define __stdcall
#define __cdecl
#define __declspec(kind)
#define ZeroMemory(place, size) memset((place), 0, (size))

/* On the card's clock. */
static inline void Sleep(DWORD ms) { drycut_sleep(ms); }
static inline DWORD GetTickCount(void) { return (DWORD)drycut_milliseconds(); }

#endif
