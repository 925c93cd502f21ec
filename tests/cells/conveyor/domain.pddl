; A sorting line (plant_models/doc/conveyor.md): one box to a zone, zones with a belt and a photo-eye each. Belts carry a
; box to the next zone; diverters push it into a chute; at the end of the line it runs off, or is pushed into the lane
; that leads back to the reader. So a box whose turn has not come lets others pass by going round.
(define (domain sorting-line)
  (:requirements :typing :negative-preconditions :numeric-fluents)
  (:types box zone chute place)
  (:predicates
    (at ?b - box ?z - zone)                ; as followed from the order list on
    (occupied ?z - zone)                   ; the zone's photo-eye is covered
    (free ?z - zone)                       ; no box is in the zone, at its eye or anywhere else
    (leads ?from ?to - zone)               ; belts carry from zone to zone
    (crosses ?from ?to - zone)             ; a pusher takes a box from zone to zone
    (infeed ?z - zone)
    (reads ?z - zone)                      ; the reader looks at the zone's end
    (diverts ?z - zone ?c - chute)         ; the pusher of a zone reaches the chute
    (ends ?z - zone ?c - chute)            ; the zone's belt leads into the chute
    (links ?from ?to - zone)               ; either way from zone to zone
    (leaves ?z - zone ?c - chute)          ; either way from the zone into the chute
    (announced ?b - box ?n - place)        ; place of a box in the order list, until it arrives
    (next ?n - place)                      ; of the order list, to arrive
    (follows ?later ?n - place)
    (wanted ?b - box ?c - chute)           ; the sorting order
    (turn ?b ?before - box)                ; ?b may enter its chute once ?before is in its own
    (sorted ?b - box)
    (safe))                                ; the contactor is closed: nothing is jammed, nobody stopped the line
  (:functions
    (number ?b - box)                      ; what the reader says of it
    (shown ?z - zone)                      ; number of the box in front of the zone's reader
    (got ?c - chute)                       ; boxes that passed the chute's counter
    (entered ?c - chute)                   ; boxes that were sent there
    (distance ?from ?to - zone)
    (travel))                              ; m that boxes were carried

  (:action feed
    :parameters (?b - box ?n ?later - place ?z - zone)
    :precondition (and (safe) (infeed ?z) (next ?n) (announced ?b ?n) (follows ?later ?n) (free ?z) (not (occupied ?z)))
    :effect (and (not (announced ?b ?n)) (not (next ?n)) (next ?later) (at ?b ?z) (occupied ?z) (not (free ?z))
                 (assign (shown ?z) (number ?b)) (increase (travel) 1)))

  (:action convey
    :parameters (?b - box ?from ?to - zone)
    :precondition (and (safe) (leads ?from ?to) (at ?b ?from) (occupied ?from) (free ?to) (not (occupied ?to))
                       (= (shown ?from) (number ?b)))
    :effect (and (not (at ?b ?from)) (not (occupied ?from)) (free ?from) (assign (shown ?from) 0)
                 (at ?b ?to) (occupied ?to) (not (free ?to)) (assign (shown ?to) (number ?b))
                 (increase (travel) (distance ?from ?to))))

  ; The box has left its zone's eye and has not come to the next one: the belts run until that sees it.
  (:action carry_on
    :parameters (?b - box ?from ?to - zone)
    :precondition (and (safe) (leads ?from ?to) (at ?b ?from) (not (occupied ?from)) (free ?to)
                       (not (occupied ?to)))
    :effect (and (not (at ?b ?from)) (free ?from) (assign (shown ?from) 0)
                 (at ?b ?to) (occupied ?to) (not (free ?to)) (assign (shown ?to) (number ?b))
                 (increase (travel) (distance ?from ?to))))

  (:action push
    :parameters (?b - box ?from ?to - zone)
    :precondition (and (safe) (crosses ?from ?to) (at ?b ?from) (occupied ?from) (free ?to)
                       (not (occupied ?to)))
    :effect (and (not (at ?b ?from)) (not (occupied ?from)) (free ?from) (assign (shown ?from) 0)
                 (at ?b ?to) (occupied ?to) (not (free ?to)) (assign (shown ?to) (number ?b))
                 (increase (travel) (distance ?from ?to))))

  ; Stopped on the way from belt to belt: pushed the rest of it.
  (:action push_on
    :parameters (?b - box ?from ?to - zone)
    :precondition (and (safe) (crosses ?from ?to) (at ?b ?from) (not (occupied ?from)) (free ?to)
                       (not (occupied ?to)))
    :effect (and (not (at ?b ?from)) (free ?from) (assign (shown ?from) 0)
                 (at ?b ?to) (occupied ?to) (not (free ?to)) (assign (shown ?to) (number ?b))
                 (increase (travel) (distance ?from ?to))))

  (:action divert
    :parameters (?b ?before - box ?z - zone ?c - chute)
    :precondition (and (safe) (diverts ?z ?c) (wanted ?b ?c) (at ?b ?z) (occupied ?z)
                       (turn ?b ?before) (sorted ?before))
    :effect (and (not (at ?b ?z)) (not (occupied ?z)) (free ?z) (assign (shown ?z) 0) (sorted ?b)
                 (increase (got ?c) 1) (increase (entered ?c) 1) (increase (travel) 1)))

  (:action run_off
    :parameters (?b ?before - box ?z - zone ?c - chute)
    :precondition (and (safe) (ends ?z ?c) (wanted ?b ?c) (at ?b ?z) (occupied ?z)
                       (turn ?b ?before) (sorted ?before))
    :effect (and (not (at ?b ?z)) (not (occupied ?z)) (free ?z) (assign (shown ?z) 0) (sorted ?b)
                 (increase (got ?c) 1) (increase (entered ?c) 1) (increase (travel) 1)))

  ; The reader shows another box than that which was followed to it: one that was announced for later has come in its
  ; place, and so it will come in the place of that. Also where that was taken for the box at the infeed meanwhile.
  (:action recognised
    :parameters (?b ?instead - box ?n - place ?z - zone)
    :precondition (and (safe) (reads ?z) (at ?instead ?z) (occupied ?z) (announced ?b ?n) (= (shown ?z) (number ?b)))
    :effect (and (not (at ?instead ?z)) (at ?b ?z) (not (announced ?b ?n)) (announced ?instead ?n)
                 (increase (travel) 100)))

  (:action exchanged
    :parameters (?b ?instead - box ?z ?in - zone)
    :precondition (and (safe) (reads ?z) (at ?instead ?z) (occupied ?z) (infeed ?in) (at ?b ?in)
                       (= (shown ?z) (number ?b)))
    :effect (and (not (at ?instead ?z)) (at ?b ?z) (not (at ?b ?in)) (at ?instead ?in)
                 (assign (shown ?in) (number ?instead)) (increase (travel) 100)))

  ; Interrupted when it was as good as done: the box is at the infeed, or at the next eye, or has slid into its chute and was counted.
  (:action fed
    :parameters (?b - box ?n ?later - place ?z - zone)
    :precondition (and (safe) (infeed ?z) (next ?n) (announced ?b ?n) (follows ?later ?n) (free ?z) (occupied ?z))
    :effect (and (not (announced ?b ?n)) (not (next ?n)) (next ?later) (at ?b ?z) (not (free ?z))
                 (assign (shown ?z) (number ?b))))

  (:action arrived
    :parameters (?b - box ?from ?to - zone)
    :precondition (and (safe) (links ?from ?to) (at ?b ?from) (not (occupied ?from)) (free ?to) (occupied ?to))
    :effect (and (not (at ?b ?from)) (free ?from) (assign (shown ?from) 0)
                 (at ?b ?to) (not (free ?to)) (assign (shown ?to) (number ?b))))

  (:action delivered
    :parameters (?b ?before - box ?z - zone ?c - chute)
    :precondition (and (safe) (leaves ?z ?c) (wanted ?b ?c) (at ?b ?z) (not (occupied ?z))
                       (turn ?b ?before) (sorted ?before) (> (got ?c) (entered ?c)))
    :effect (and (not (at ?b ?z)) (free ?z) (assign (shown ?z) 0) (sorted ?b)
                 (increase (entered ?c) 1)))

  ; The safety program has opened the contactor. Nothing moves until somebody has put things right and pressed reset.
  (:action await_reset
    :parameters ()
    :precondition (not (safe))
    :effect (and (safe) (increase (travel) 100))))
