; The installer for Windows: for one user, without rights of an administrator. All that it writes it takes away again.
Unicode true
Target amd64-unicode
!include "MUI2.nsh"
!ifndef VERSION
  !define VERSION "0.0.0"
!endif
!ifndef BUNDLE
  !define BUNDLE "..\..\dist\drycut"
!endif
!ifndef OUTPUT
  !define OUTPUT "..\..\dist\drycut-${VERSION}-setup.exe"
!endif
!define CLASSES "Software\Classes"
!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\drycut"

Name "drycut ${VERSION}"
OutFile "${OUTPUT}"
RequestExecutionLevel user
InstallDir "$LOCALAPPDATA\Programs\drycut"
InstallDirRegKey HKCU "${UNINSTALL}" "InstallLocation"
SetCompressor /SOLID lzma

!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!define MUI_FINISHPAGE_RUN "$INSTDIR\drycut-page.exe"
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "SimpChinese"
!insertmacro MUI_LANGUAGE "English"

LangString PROGRAM ${LANG_ENGLISH} "Wire-cut program"
LangString PROGRAM ${LANG_SIMPCHINESE} "线切割程序"

Section
  SetOutPath "$INSTDIR"
  File /r "${BUNDLE}/*"
  WriteUninstaller "$INSTDIR\uninstall.exe"
  CreateShortcut "$SMPROGRAMS\drycut.lnk" "$INSTDIR\drycut-page.exe"
  CreateShortcut "$DESKTOP\drycut.lnk" "$INSTDIR\drycut-page.exe"
  WriteRegStr HKCU "${CLASSES}\drycut.program" "" "$(PROGRAM)"
  WriteRegStr HKCU "${CLASSES}\drycut.program\DefaultIcon" "" "$INSTDIR\drycut-page.exe,0"
  WriteRegStr HKCU "${CLASSES}\drycut.program\shell\open\command" "" '"$INSTDIR\drycut-page.exe" "%1"'
  WriteRegStr HKCU "${CLASSES}\.3b\OpenWithProgids" "drycut.program" ""
  WriteRegStr HKCU "${CLASSES}\.4b\OpenWithProgids" "drycut.program" ""
  WriteRegStr HKCU "${CLASSES}\.3b" "" "drycut.program"
  WriteRegStr HKCU "${CLASSES}\.4b" "" "drycut.program"
  WriteRegStr HKCU "${UNINSTALL}" "DisplayName" "drycut ${VERSION}"
  WriteRegStr HKCU "${UNINSTALL}" "DisplayVersion" "${VERSION}"
  WriteRegStr HKCU "${UNINSTALL}" "InstallLocation" "$INSTDIR"
  WriteRegStr HKCU "${UNINSTALL}" "UninstallString" '"$INSTDIR\uninstall.exe"'
  System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
SectionEnd

Section "Uninstall"
  Delete "$SMPROGRAMS\drycut.lnk"
  Delete "$DESKTOP\drycut.lnk"
  DeleteRegKey HKCU "${CLASSES}\drycut.program"
  DeleteRegValue HKCU "${CLASSES}\.3b\OpenWithProgids" "drycut.program"
  DeleteRegValue HKCU "${CLASSES}\.4b\OpenWithProgids" "drycut.program"
  ReadRegStr $0 HKCU "${CLASSES}\.3b" ""
  StrCmp $0 "drycut.program" 0 +2
    DeleteRegValue HKCU "${CLASSES}\.3b" ""
  ReadRegStr $0 HKCU "${CLASSES}\.4b" ""
  StrCmp $0 "drycut.program" 0 +2
    DeleteRegValue HKCU "${CLASSES}\.4b" ""
  DeleteRegKey /ifempty HKCU "${CLASSES}\.3b\OpenWithProgids"
  DeleteRegKey /ifempty HKCU "${CLASSES}\.4b\OpenWithProgids"
  DeleteRegKey /ifempty HKCU "${CLASSES}\.3b"
  DeleteRegKey /ifempty HKCU "${CLASSES}\.4b"
  DeleteRegKey HKCU "${UNINSTALL}"
  RMDir /r "$INSTDIR\_internal"
  Delete "$INSTDIR\drycut.exe"
  Delete "$INSTDIR\drycut-page.exe"
  Delete "$INSTDIR\uninstall.exe"
  RMDir "$INSTDIR"
  System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
SectionEnd
