@tool
extends EditorPlugin
## Adds the nodes of this folder to the list of nodes, which their class names already do, and keeps
## the add-on switchable in the project settings.
