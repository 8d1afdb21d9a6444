"""The panel of a control under sparks, `panel.html`: live in the browser, by the same loops as a run.

`PanelEntry` goes in.
"""
